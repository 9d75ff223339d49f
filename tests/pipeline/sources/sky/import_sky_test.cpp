#include "pipeline/sources/sky/import_sky.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/sources/sky/healpix_map.h"
#include "pipeline/sources/sky/read_sky.h"
#include "tests/pipeline/image/gzipped.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr float kUnseen = -1.6375e30f, kNan = std::numeric_limits<float>::quiet_NaN();

class ImportSky : public TestFolder {
 protected:
  // A HEALPix map of 48 pixels.
  SkyImport healpix(const std::function<float(int)>& value,
                    const std::string& coordinates = "G") const {
    std::string data;
    for (int k = 0; k < 48; ++k)
      for (int shift = 24; shift >= 0; shift -= 8)
        data += static_cast<char>(std::bit_cast<std::uint32_t>(value(k)) >> shift & 0xff);
    data.resize(kFitsBlock, 0);
    SkyImport import;
    import.image = folder_ / "map.fits", import.out = folder_ / "map.sky";
    put(import.image,
        fits_header({"SIMPLE  = T", "BITPIX  = 8", "NAXIS   = 0", "EXTEND  = T"}) +
            fits_header({"XTENSION= 'BINTABLE'", "BITPIX  = 8", "NAXIS   = 2", "NAXIS1  = 4",
                         "NAXIS2  = 48", "PCOUNT  = 0", "GCOUNT  = 1", "TFIELDS = 1",
                         "TFORM1  = '1E'", "TUNIT1  = 'K'", "NSIDE   = 2", "ORDERING= 'RING'",
                         "COORDSYS= '" + coordinates + "'"}) +
            data);
    return import;
  }

  static std::string refusal_of(const SkyImport& import) {
    const std::string said = message_of([&] { import_sky(import); });
    EXPECT_TRUE(said.empty() || !fs::exists(import.out));
    return said;
  }
};

TEST_F(ImportSky, AHealpixMapWithoutAnyValueIsRefusedByName) {
  for (const bool cmb : {false, true}) {
    SkyImport import = healpix([](int k) { return k % 2 ? kUnseen : kNan; });
    if (cmb) import.cmb = CmbSettings{};
    EXPECT_EQ(refusal_of(import),
              import.image.string() +
                  ": column 1 holds no value: all 48 pixels are missing (UNSEEN, NaN or infinite)");
  }
}

TEST_F(ImportSky, AHealpixMapOfNegativeValuesIsNoLightButMayBeFluctuations) {
  SkyImport import =
      healpix([](int k) { return k % 2 ? kUnseen : -1e-5f * static_cast<float>(k); });
  EXPECT_THAT(refusal_of(import),
              HasSubstr("map.fits: there is no light in it: no value exceeds 0, "
                        "and they go down to -0.00046"));
  import.cmb = CmbSettings{};
  EXPECT_EQ(refusal_of(import), "");
}

// Its darkest parts are no floor of a panorama, so that shows ask for it.
TEST_F(ImportSky, TheMicrowaveBackgroundIsKnownByItsFile) {
  SkyImport import = healpix([](int k) { return 1e-5f * static_cast<float>(k); });
  import.text = "licence: a map of the microwave background: free\n";
  EXPECT_EQ(refusal_of(import), "");
  EXPECT_FALSE(read_sky(import.out).is_microwave_background);
  import.cmb = CmbSettings{};
  EXPECT_EQ(refusal_of(import), "");
  EXPECT_TRUE(read_sky(import.out).is_microwave_background);
}

TEST_F(ImportSky, TheFrameOfAHealpixMapIsALetterOrAWord) {
  const auto frame_of = [&](const char* coordinates) {
    return import_sky(healpix([](int) { return 1.0f; }, coordinates)).frame;
  };
  for (const char* word : {"G", "g", "G       ", " G", "GAL", "Galactic", "galactic", "\"G\""})
    EXPECT_EQ(frame_of(word), SkyFrame::kGalactic) << word;
  for (const char* word : {"C", "c", "Q", "CEL", "Celestial", "EQ", "Equatorial", "equatorial",
                           "ICRS", "icrs", "FK5", "J2000"})
    EXPECT_EQ(frame_of(word), SkyFrame::kEquatorial) << word;
  const auto refusal = [&](const char* coordinates) {
    fs::remove(folder_ / "map.sky");
    return refusal_of(healpix([](int) { return 1.0f; }, coordinates));
  };
  EXPECT_THAT(refusal("E"), HasSubstr("(COORDSYS) are 'E', which are ecliptic; only galactic"));
  EXPECT_THAT(refusal("Ecliptic"), HasSubstr("(COORDSYS) are 'ECLIPTIC'; only galactic"));
  EXPECT_THAT(refusal("unknown"), HasSubstr("(COORDSYS) are 'UNKNOWN'; only galactic"));
  EXPECT_THAT(refusal(" "), HasSubstr("give --frame"));
}

TEST_F(ImportSky, AHealpixMapMayBePackedByGzip) {
  SkyImport import = healpix([](int k) { return static_cast<float>(k); });
  EXPECT_EQ(import_sky(import).frame, SkyFrame::kGalactic);
  const std::string plain = contents(import.out), fits = contents(import.image);
  import.image = folder_ / "packed";
  put(import.image, gzipped(fits));
  EXPECT_EQ(import_sky(import).frame, SkyFrame::kGalactic);
  const auto end = [](const std::string& file) { return file.substr(file.size() - 1000); };
  EXPECT_EQ(end(contents(import.out)), end(plain));
  fs::remove(import.out);
  put(import.image, gzipped(fits).substr(0, 300));
  EXPECT_EQ(refusal_of(import), import.image.string() + ": the gzip file is cut short");
}

TEST_F(ImportSky, OnePixelOfLightIsEnough) {
  EXPECT_EQ(refusal_of(healpix([](int k) { return k == 7 ? 1.0f : -1.0f; })), "");
}

using std::numbers::pi;

// The whole table, summed up; the sums are those of chealpix 3.30's nest2ring.
TEST(Healpix, NestedPixelsAreWhereTheReferenceHasThem) {
  for (const auto& [nside, expected] : {std::pair<int, std::uint64_t>{1, 2349475607635895542u},
                                        {2, 15279610896505409068u},
                                        {4, 15787985093515338192u},
                                        {8, 2280732109238695296u},
                                        {64, 926101480829795840u}}) {
    std::uint64_t sum = 0;
    for (long p = 0; p < 12L * nside * nside; ++p)
      sum = sum * 1000003 + static_cast<std::uint64_t>(ring_from_nested(nside, p));
    EXPECT_EQ(sum, expected) << nside;
  }
}

HealpixMap only(int nside, std::size_t pixel, bool nested = false) {
  HealpixFile file;
  file.nside = nside;
  file.nested = nested;
  file.values.assign(12 * static_cast<std::size_t>(nside * nside), 0.0f);
  file.values[pixel] = 1;
  return {file, 0};
}

// Centres as chealpix 3.30's pix2vec_ring gives them, one in each zone.
TEST(Healpix, APixelIsSeenWholeInItsCentre) {
  for (const auto& [pixel, centre] :
       {std::pair<std::size_t, V3d>{0, {0.143583841, 0.143583841, 0.979166667}},
        {37, {0.414097602, -0.619740858, 0.666666667}},
        {74, {0.697216689, 0.697216689, 0.166666667}},
        {111, {-0.910957504, 0.377330953, -0.166666667}},
        {148, {0, -0.866025404, -0.5}},
        {185, {-0.152940439, -0.369230882, -0.916666667}}})
    EXPECT_NEAR(only(4, pixel).at(centre), 1, 1e-6) << pixel;
  EXPECT_NEAR(only(4, 0, true).at({0.697216689, 0.697216689, 0.166666667}), 1, 1e-6)
      << "nested 0 is 74 of the rings";
}

// A smooth function set at the pixels' centres comes back everywhere; poles and longitude 0 too.
TEST(Healpix, LooksBetweenPixelsAreSmooth) {
  const int nside = 32;
  const auto f = [](const V3d& d) { return 1 + 0.5 * d.x - 0.3 * d.y * d.z + 0.2 * d.z; };
  // Which pixel a place is nearest to is asked of the map itself, one ring at a time.
  HealpixFile file;
  file.nside = nside;
  for (long ring = 1; ring < 4 * nside; ++ring) {
    const long north = std::min(ring, 4L * nside - ring), count = 4 * std::min<long>(north, nside);
    const double k = static_cast<double>(north), n = nside;
    const double z = north < nside ? (1 - k * k / (3 * n * n)) * (ring == north ? 1 : -1)
                                   : (2 * n - static_cast<double>(ring)) * 2 / (3 * n);
    const double shift = north < nside || (ring - nside) % 2 == 0 ? 0.5 : 0;
    for (long p = 0; p < count; ++p) {
      const double phi = 2 * pi * (static_cast<double>(p) + shift) / static_cast<double>(count);
      const double s = std::sqrt(1 - z * z);
      file.values.push_back(static_cast<float>(f({s * std::cos(phi), s * std::sin(phi), z})));
    }
  }
  ASSERT_EQ(file.values.size(), 12u * nside * nside);
  const HealpixMap map(file, 0);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<V3d> places{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1, -1e-12, 0.3}, {1, 1e-12, -0.3}};
  for (int k = 0; k < 20000; ++k)
    places.emplace_back(normal(random), normal(random), normal(random));
  for (const V3d& raw : places) {
    const V3d d = raw.normalized();
    // Half the curvature times a pixel squared.  About the poles, what a ring's square of four
    // pixels misses of its circle: the slope, 0.58, times its radius, 0.0255, times 1 - cos 45
    // degrees.
    EXPECT_NEAR(map.at(d), f(d), std::abs(d.z) > 0.97 ? 4.4e-3 : 6e-4) << d;
  }
}

TEST(Healpix, MissingPixelsTakeTheirPlaceholder) {
  HealpixFile file;
  file.values.assign(12, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(HealpixMap(file, 0.25f).at({0.3, 0.2, -1}), 0.25);
}

TEST(MicrowaveBackground, IsABlackbodyWithItsFluctuationsEnlarged) {
  HealpixFile file;  // in mK; even, except for some strong pixels in the south
  file.values.assign(12, 0.05f);
  for (std::size_t k = 8; k < 12; ++k) file.values[k] = 100;
  const HealpixMap map(file, 0);
  CmbSettings cmb;
  cmb.kelvin = 1e-3;
  const SkyPyramid pyramid(SkyMapKind::kThermal, cmb_unit(cmb), 16);
  paint_cmb(map, SkyFrame::kEquatorial, cmb, pyramid);
  pyramid.finish();
  const SkyMap sky = pyramid.map();
  const double warm = 2997.5 * (1 + 4000 * 0.05e-3 / 2.725), hot = 2997.5 * 1.5;
  const ThermalLight north = sky.sample_thermal({0, 0, 1}, 0),
                     south = sky.sample_thermal({0, 0, -1}, 0);
  EXPECT_NEAR(north.temperature, warm, 3e-3 * warm);
  EXPECT_NEAR(south.temperature, hot, 3e-3 * hot);
  EXPECT_NEAR(south.radiance / north.radiance, std::pow(hot / warm, 4),
              5e-3 * std::pow(hot / warm, 4));
  file.values.assign(12, 0);
  paint_cmb(HealpixMap(file, 0), SkyFrame::kGalactic, cmb, pyramid);
  EXPECT_NEAR(luminance(sky.sample({1, 0, 0}, 0)), cmb.luminance, 0.02 * cmb.luminance);
}

}  // namespace
}  // namespace domefall
