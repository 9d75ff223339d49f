// What skies are imported from: HEALPix maps in FITS, made here byte by byte, and large pictures.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/pipeline/image/gzipped.h"
#include "tests/pipeline/image/picture_bytes.h"

namespace domefall {
namespace {

using testing::HasSubstr;

class SkyImages : public PictureColours {
 protected:
  // What is said of a HEALPix file with these contents, or nothing if it is read.
  std::string healpix_refusal(const std::string& bytes, int column) const {
    put(folder_ / "map.fits", bytes);
    const std::string said = message_of([&] { read_healpix(folder_ / "map.fits", column); });
    EXPECT_TRUE(said.empty() || said.starts_with((folder_ / "map.fits").string())) << said;
    return said;
  }
};

std::string card(const std::string& key, const std::string& value) {
  std::string padded = key;
  padded.resize(8, ' ');
  return padded + "= " + value;
}

std::string fits_bytes(float value) { return be(std::bit_cast<std::uint32_t>(value), 4); }

// A file whose first extension is a table of two columns.
std::string table(std::vector<std::string> cards, std::string data) {
  const std::vector<std::string> first{card("XTENSION", "'BINTABLE'"), card("BITPIX", "8"),
                                       card("NAXIS", "2")},
      then{card("PCOUNT", "0"), card("GCOUNT", "1"), card("TFIELDS", "2")};
  cards.insert(cards.begin() + 2, then.begin(), then.end());
  cards.insert(cards.begin(), first.begin(), first.end());
  data.resize(kFitsBlock, 0);
  return fits_header(
             {card("SIMPLE", "T"), card("BITPIX", "8"), card("NAXIS", "0"), card("EXTEND", "T")}) +
         fits_header(cards) + data;
}

// 48 pixels, 16 a row, in two columns: k and -k; the fourth is a bad one.
std::string healpix_file(const std::string& ordering, const std::vector<std::string>& more) {
  std::vector<std::string> cards{card("NAXIS1", "128"), card("NAXIS2", "3"),
                                 card("TFORM1", "'16E'"), card("TFORM2", "'16E'"),
                                 card("TUNIT2", "'mK,thermodynamic'")};
  cards.push_back(card("NSIDE", "2"));
  cards.push_back(card("ORDERING", "'" + ordering + "'"));
  cards.insert(cards.end(), more.begin(), more.end());
  std::string data;
  for (int row = 0; row < 3; ++row)
    for (int sign : {1, -1})
      for (int k = 0; k < 16; ++k) {
        const int pixel = 16 * row + k;
        data += fits_bytes(pixel == 3 ? -1.6375e30f : static_cast<float>(sign * pixel));
      }
  return table(cards, data);
}

TEST_F(SkyImages, AHealpixMapIsReadColumnByColumn) {
  const fs::path path = folder_ / "map.fits";
  put(path, healpix_file("NESTED", {card("COORDSYS", "'G       '")}));
  const HealpixFile map = read_healpix(path, 2);
  EXPECT_EQ(map.nside, 2);
  EXPECT_TRUE(map.nested);
  EXPECT_EQ(map.coordinates, "G");
  EXPECT_EQ(map.units, "mK,thermodynamic");
  ASSERT_EQ(map.values.size(), 48u);
  for (std::size_t k = 0; k < 48; ++k) {
    if (k == 3)
      EXPECT_TRUE(std::isnan(map.values[k])) << "a bad pixel";
    else
      EXPECT_EQ(map.values[k], -static_cast<float>(k));
  }
  EXPECT_EQ(read_healpix(path, 1).values[47], 47);
  EXPECT_EQ(read_healpix(path, 1).units, "");
}

TEST_F(SkyImages, WhatIsNoWholeHealpixMapIsRefusedByName) {
  const auto said = [this](const std::string& contents, int column) {
    return healpix_refusal(contents, column);
  };
  const std::string whole = healpix_file("RING", {});
  EXPECT_EQ(said(whole, 1), "");
  EXPECT_THAT(said(whole, 3), HasSubstr("no column 3"));
  EXPECT_THAT(said(healpix_file("SPIRAL", {}), 1), HasSubstr("ORDERING must be RING or NESTED"));
  EXPECT_THAT(said(healpix_file("", {}), 1), HasSubstr("how its pixels are numbered"));
  EXPECT_THAT(said("no FITS", 1), HasSubstr("not a FITS file"));
  EXPECT_NE(said(whole.substr(0, 2 * kFitsBlock + 100), 1), "") << "cut short";
  EXPECT_THAT(said(fits_header({card("SIMPLE", "T"), card("BITPIX", "8"), card("NAXIS", "0")}), 1),
              HasSubstr("no HEALPix map"));
  std::string wrong = whole;
  wrong.replace(wrong.find("NSIDE   = 2"), 11, "NSIDE   = 4");
  EXPECT_THAT(said(wrong, 1), HasSubstr("does not hold the 192 numbers"));
  std::string stated_less = whole;
  stated_less.replace(stated_less.find("NSIDE   = 2"), 11, "NUSED   = 2");
  stated_less.replace(stated_less.find("NAXIS2  = 3"), 11, "NAXIS2  = 2");
  EXPECT_THAT(said(stated_less, 1), HasSubstr("no HEALPix map"));
  EXPECT_THAT(said("\x1f\x8b\x08", 1), HasSubstr("the gzip file is cut short"));
  EXPECT_THAT(said(gzipped("no FITS"), 1), HasSubstr("not a FITS file, packed by gzip"));
  EXPECT_THAT(said(gzipped(whole.substr(0, 2 * kFitsBlock + 100)), 1), HasSubstr("map.fits: "));
}

TEST_F(SkyImages, AHealpixMapMayLackNsideAndWriteItsWordsInAnyWay) {
  const fs::path path = folder_ / "map.fits.gz";
  for (const char* ordering : {"nested", "Nest", " NESTED ", "\"nested\""}) {
    std::string file = healpix_file("ORDER", {card("COORDSYS", "'\"galactic\"'")});
    file.replace(file.find("NSIDE   = 2"), 11, "NUSED   = 2");
    const std::string padded = "'" + std::string(ordering) + "'";
    file.replace(file.find("'ORDER'"), padded.size(), padded);
    for (const bool packed : {false, true}) {
      put(path, (packed ? gzipped(file) : file));
      const HealpixFile map = read_healpix(path, 1);
      EXPECT_EQ(map.nside, 2);
      EXPECT_TRUE(map.nested) << ordering;
      EXPECT_EQ(map.coordinates, "GALACTIC");
      EXPECT_EQ(map.values[47], 47);
    }
  }
}

// Pixels 5, 47 and 0 of 48, with the values 50, 470 and 0.
std::string listed_file(const std::vector<int>& pixels, const std::string& nside) {
  std::vector<std::string> cards{card("NAXIS1", "8"),
                                 card("NAXIS2", "3"),
                                 card("TFORM1", "'1J'"),
                                 card("TFORM2", "'1E'"),
                                 card("TUNIT2", "'mK'"),
                                 card("PIXTYPE", "'HEALPIX'"),
                                 card("INDXSCHM", "'EXPLICIT'"),
                                 card("ORDERING", "'RING'"),
                                 card("OBJECT", "'PARTIAL'")};
  if (!nside.empty()) cards.push_back(card("NSIDE", nside));
  std::string data;
  for (const int pixel : pixels) {
    data += be(static_cast<std::uint32_t>(pixel), 4);
    data += fits_bytes(10 * static_cast<float>(pixel));
  }
  return table(cards, data);
}

TEST_F(SkyImages, AHealpixMapThatListsItsPixelsIsBadElsewhere) {
  const fs::path path = folder_ / "map.fits";
  put(path, listed_file({5, 47, 0}, "2"));
  const HealpixFile map = read_healpix(path, 1);
  EXPECT_EQ(map.units, "mK");
  ASSERT_EQ(map.values.size(), 48u);
  for (std::size_t k = 0; k < 48; ++k) {
    if (k == 5 || k == 47 || k == 0)
      EXPECT_EQ(map.values[k], 10 * static_cast<float>(k));
    else
      EXPECT_TRUE(std::isnan(map.values[k])) << k;
  }
  const auto refusal = [&](const std::vector<int>& pixels, const std::string& nside, int column) {
    return healpix_refusal(listed_file(pixels, nside), column);
  };
  EXPECT_THAT(refusal({5, 48, 0}, "2", 1),
              HasSubstr("entry 2 of column 1 is 48; pixels are numbered "
                        "from 0 to 47"));
  EXPECT_THAT(refusal({5, 4, -1}, "2", 1), HasSubstr("entry 3 of column 1 is -1"));
  EXPECT_THAT(refusal({5, 4, 5}, "2", 1), HasSubstr("pixel 5 is listed twice"));
  EXPECT_THAT(refusal({5, 4, 0}, "", 1), HasSubstr("lists its pixels, and has no keyword NSIDE"));
  EXPECT_THAT(refusal({5, 4, 0}, "8192", 1), HasSubstr("from 1 to 4096 in a map that lists"));
  EXPECT_THAT(refusal({5, 4, 0}, "2", 2), HasSubstr("no column 2"));
}

// 3.2 GB of them, of which the file has three rows.
TEST_F(SkyImages, AHealpixHeaderThatStatesMoreThanTheFileHoldsTakesNoMemory) {
  std::string file = healpix_file("RING", {});
  const auto state = [&file](const std::string& from, const std::string& to) {
    file.replace(file.find(from), to.size(), to);
  };
  state("NSIDE   = 2", "NSIDE   = 8192");
  state("NAXIS2  = 3", "NAXIS2  = 50331648");
  const fs::path path = folder_ / "map.fits";
  put(path, file);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_THAT(
      message_of([&] { read_healpix(path, 1); }),
      HasSubstr("the file is cut short: its table of 50331648 rows of 128 bytes is longer"));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 400000) << "kB";
}

TEST_F(SkyImages, AHealpixMapIsLookedForInAHundredExtensions) {
  const std::string empty =
      fits_header({card("XTENSION", "'IMAGE   '"), card("BITPIX", "8"), card("NAXIS", "0"),
                   card("PCOUNT", "0"), card("GCOUNT", "1")});
  const std::string whole = healpix_file("RING", {});
  const auto with = [&](int extensions) {
    std::string file = whole.substr(0, kFitsBlock);
    for (int k = 0; k < extensions; ++k) file += empty;
    put(folder_ / "map.fits", file + whole.substr(kFitsBlock));
    return folder_ / "map.fits";
  };
  EXPECT_EQ(read_healpix(with(98), 1).nside, 2);
  EXPECT_THAT(message_of([&] { read_healpix(with(99), 1); }),
              HasSubstr("among its first 100 extensions"));
}

TEST_F(SkyImages, PicturesComeByRowsAndTilesInTheirOwnEncoding) {
  const int width = 200, height = 100;
  std::vector<float> values;
  for (int k = 0; k < width * height; ++k)
    for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>((k * 7 + c * 50) % 256) / 255);
  OIIO::ImageSpec rows(width, height, 3, OIIO::TypeDesc::UINT8), tiles = rows;
  tiles.tile_width = tiles.tile_height = 64;
  written("rows.tif", rows, values);
  written("tiles.tif", tiles, values);
  const LightImage a = read_light_image(folder_ / "rows.tif", PixelEncoding::kOfFile),
                   b = read_light_image(folder_ / "tiles.tif", PixelEncoding::kOfFile),
                   linear = read_light_image(folder_ / "rows.tif", PixelEncoding::kLinear);
  EXPECT_EQ(a.unit, 1);
  ASSERT_EQ(a.pixels.pixels.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_EQ(a.pixels.pixels[k].bits(), b.pixels.pixels[k].bits());
    const double v = values[k];
    const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(a.pixels.pixels[k], light, 5e-4 * light + 1e-7);
    EXPECT_NEAR(linear.pixels.pixels[k], v, 5e-4 * v + 1e-7);
  }
}

TEST_F(SkyImages, FloatsBeyondAHalfHaveAUnitAndNegativeLightIsNone) {
  const fs::path path = folder_ / "floats.tif";
  written(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT), {3e9f, -1});
  const LightImage image = read_light_image(path, PixelEncoding::kOfFile);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(image.pixels.pixels[static_cast<std::size_t>(c)] * image.unit, 3e9, 1.5e6);
    EXPECT_EQ(image.pixels.pixels[static_cast<std::size_t>(3 + c)], 0.0f);
  }
  written(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT),
          {1, std::numeric_limits<float>::quiet_NaN()});
  EXPECT_THAT(message_of([&] { read_light_image(path, PixelEncoding::kOfFile); }),
              HasSubstr("pixel (2, 1) is not a finite number"));
}

// As a picture of logarithms is.
TEST_F(SkyImages, APictureOfNegativeValuesOnlyIsRefusedByName) {
  const fs::path path = folder_ / "logs.tif";
  written(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT), {-3, -0.25f});
  EXPECT_EQ(
      message_of([&] { read_light_image(path, PixelEncoding::kOfFile); }),
      path.string() + ": there is no light in it: no value exceeds 0, and they go down to -3");
  written(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT), {0, 0});
  EXPECT_EQ(read_light_image(path, PixelEncoding::kOfFile).pixels.pixels[0], 0.0f);
}

}  // namespace
}  // namespace domefall
