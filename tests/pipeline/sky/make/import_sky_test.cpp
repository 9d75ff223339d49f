#include "pipeline/sky/make/import_sky.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "pipeline/image/errors.h"
#include "pipeline/sky/read_sky.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::size_t kFitsBlock = 2880;
constexpr float kUnseen = -1.6375e30f, kNan = std::numeric_limits<float>::quiet_NaN();

class ImportSky : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string cards(const std::vector<std::string>& lines) {
    std::string out;
    for (std::string line : lines) line.resize(80, ' '), out += line;
    out += "END";
    out.resize((out.size() + kFitsBlock - 1) / kFitsBlock * kFitsBlock, ' ');
    return out;
  }

  // A HEALPix map of 48 pixels.
  SkyImport healpix(const std::function<float(int)>& value) const {
    std::string data;
    for (int k = 0; k < 48; ++k)
      for (int shift = 24; shift >= 0; shift -= 8)
        data += static_cast<char>(std::bit_cast<std::uint32_t>(value(k)) >> shift & 0xff);
    data.resize(kFitsBlock, 0);
    SkyImport import;
    import.image = folder_ / "map.fits", import.out = folder_ / "map.sky";
    std::ofstream(import.image, std::ios::binary)
        << cards({"SIMPLE  = T", "BITPIX  = 8", "NAXIS   = 0", "EXTEND  = T"}) +
               cards({"XTENSION= 'BINTABLE'", "BITPIX  = 8", "NAXIS   = 2", "NAXIS1  = 4",
                      "NAXIS2  = 48", "PCOUNT  = 0", "GCOUNT  = 1", "TFIELDS = 1", "TFORM1  = '1E'",
                      "TUNIT1  = 'K'", "NSIDE   = 2", "ORDERING= 'RING'", "COORDSYS= 'G'"}) +
               data;
    return import;
  }

  static std::string refusal_of(const SkyImport& import) {
    try {
      import_sky(import);
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(import.out));
      return error.what();
    }
    return "";
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("domefall_import_sky_" + std::to_string(getpid()));
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

TEST_F(ImportSky, OnePixelOfLightIsEnough) {
  EXPECT_EQ(refusal_of(healpix([](int k) { return k == 7 ? 1.0f : -1.0f; })), "");
}

}  // namespace
}  // namespace domefall
