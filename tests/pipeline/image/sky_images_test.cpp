// What skies are imported from: HEALPix maps in FITS, made here byte by byte, and large pictures.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "pipeline/image/errors.h"
#include "pipeline/image/light_image.h"
#include "pipeline/image/read_healpix.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SkyImages : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("domefall_sky_images_" + std::to_string(getpid()));
};

constexpr std::size_t kBlock = 2880;

std::string block(const std::vector<std::string>& cards) {
  std::string out;
  for (std::string card : cards) {
    card.resize(80, ' ');
    out += card;
  }
  out += "END";
  out.resize((out.size() + kBlock - 1) / kBlock * kBlock, ' ');
  return out;
}

std::string card(const std::string& key, const std::string& value) {
  std::string padded = key;
  padded.resize(8, ' ');
  return padded + "= " + value;
}

std::string fits_bytes(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(bits >> shift & 0xff);
  return out;
}

// 48 pixels, 16 a row, in two columns: k and -k; the fourth is a bad one.
std::string healpix_file(const std::string& ordering, const std::vector<std::string>& more) {
  std::vector<std::string> cards{card("XTENSION", "'BINTABLE'"),
                                 card("BITPIX", "8"),
                                 card("NAXIS", "2"),
                                 card("NAXIS1", "128"),
                                 card("NAXIS2", "3"),
                                 card("PCOUNT", "0"),
                                 card("GCOUNT", "1"),
                                 card("TFIELDS", "2"),
                                 card("TFORM1", "'16E'"),
                                 card("TFORM2", "'16E'"),
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
  data.resize(kBlock, 0);
  return block(
             {card("SIMPLE", "T"), card("BITPIX", "8"), card("NAXIS", "0"), card("EXTEND", "T")}) +
         block(cards) + data;
}

TEST_F(SkyImages, AHealpixMapIsReadColumnByColumn) {
  const fs::path path = folder_ / "map.fits";
  std::ofstream(path, std::ios::binary) << healpix_file("NESTED", {card("COORDSYS", "'G       '")});
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
  const fs::path path = folder_ / "map.fits";
  const auto said = [&path](const std::string& contents, int column) -> std::string {
    std::ofstream(path, std::ios::binary) << contents;
    try {
      read_healpix(path, column);
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path.string())) << error.what();
      return error.what();
    }
    return "";
  };
  const std::string whole = healpix_file("RING", {});
  EXPECT_EQ(said(whole, 1), "");
  EXPECT_THAT(said(whole, 3), HasSubstr("no column 3"));
  EXPECT_THAT(said(healpix_file("SPIRAL", {}), 1), HasSubstr("ORDERING must be RING or NESTED"));
  EXPECT_THAT(said(healpix_file("RING", {card("INDXSCHM", "'EXPLICIT'")}), 1),
              HasSubstr("lists its pixels"));
  EXPECT_THAT(said("no FITS", 1), HasSubstr("not a FITS file"));
  EXPECT_NE(said(whole.substr(0, 2 * kBlock + 100), 1), "") << "cut short";
  EXPECT_THAT(said(block({card("SIMPLE", "T"), card("BITPIX", "8"), card("NAXIS", "0")}), 1),
              HasSubstr("no HEALPix map"));
  std::string wrong = whole;
  wrong.replace(wrong.find("NSIDE   = 2"), 11, "NSIDE   = 4");
  EXPECT_THAT(said(wrong, 1), HasSubstr("does not hold the 192 numbers"));
  // A gzip file, which CFITSIO would unpack.
  EXPECT_THAT(said("\x1f\x8b\x08", 1), HasSubstr("not a FITS file"));
}

// 3.2 GB of them, of which the file has three rows.
TEST_F(SkyImages, AHealpixHeaderThatStatesMoreThanTheFileHoldsTakesNoMemory) {
  std::string file = healpix_file("RING", {});
  const auto put = [&file](const std::string& from, const std::string& to) {
    file.replace(file.find(from), to.size(), to);
  };
  put("NSIDE   = 2", "NSIDE   = 8192");
  put("NAXIS2  = 3", "NAXIS2  = 50331648");
  const fs::path path = folder_ / "map.fits";
  std::ofstream(path, std::ios::binary) << file;
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_THAT([&] { read_healpix(path, 1); },
              testing::ThrowsMessage<InputError>(HasSubstr(
                  "the file is cut short: its table of 50331648 rows of 128 bytes is longer")));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 400000) << "kB";
}

TEST_F(SkyImages, AHealpixMapIsLookedForInAHundredExtensions) {
  const std::string empty = block({card("XTENSION", "'IMAGE   '"), card("BITPIX", "8"),
                                   card("NAXIS", "0"), card("PCOUNT", "0"), card("GCOUNT", "1")});
  const std::string whole = healpix_file("RING", {});
  const auto with = [&](int extensions) {
    std::string file = whole.substr(0, kBlock);
    for (int k = 0; k < extensions; ++k) file += empty;
    std::ofstream(folder_ / "map.fits", std::ios::binary) << file + whole.substr(kBlock);
    return folder_ / "map.fits";
  };
  EXPECT_EQ(read_healpix(with(98), 1).nside, 2);
  EXPECT_THAT([&] { read_healpix(with(99), 1); },
              testing::ThrowsMessage<InputError>(HasSubstr("among its first 100 extensions")));
}

void write_image(const fs::path& path, OIIO::ImageSpec spec, const std::vector<float>& values) {
  const auto out = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(out && out->open(path.string(), spec)) << OIIO::geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
  ASSERT_TRUE(out->close());
}

TEST_F(SkyImages, PicturesComeByRowsAndTilesInTheirOwnEncoding) {
  const int width = 200, height = 100;
  std::vector<float> values;
  for (int k = 0; k < width * height; ++k)
    for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>((k * 7 + c * 50) % 256) / 255);
  OIIO::ImageSpec rows(width, height, 3, OIIO::TypeDesc::UINT8), tiles = rows;
  tiles.tile_width = tiles.tile_height = 64;
  write_image(folder_ / "rows.tif", rows, values);
  write_image(folder_ / "tiles.tif", tiles, values);
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
  write_image(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT), {3e9f, -1});
  const LightImage image = read_light_image(path, PixelEncoding::kOfFile);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(image.pixels.pixels[static_cast<std::size_t>(c)] * image.unit, 3e9, 1.5e6);
    EXPECT_EQ(image.pixels.pixels[static_cast<std::size_t>(3 + c)], 0.0f);
  }
  write_image(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT),
              {1, std::numeric_limits<float>::quiet_NaN()});
  try {
    read_light_image(path, PixelEncoding::kOfFile);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pixel (2, 1) is not a finite number"));
  }
}

// As a picture of logarithms is.
TEST_F(SkyImages, APictureOfNegativeValuesOnlyIsRefusedByName) {
  const fs::path path = folder_ / "logs.tif";
  write_image(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT), {-3, -0.25f});
  try {
    read_light_image(path, PixelEncoding::kOfFile);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        error.what(),
        path.string() + ": there is no light in it: no value exceeds 0, and they go down to -3");
  }
  write_image(path, OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::FLOAT), {0, 0});
  EXPECT_EQ(read_light_image(path, PixelEncoding::kOfFile).pixels.pixels[0], 0.0f);
}

}  // namespace
}  // namespace domefall
