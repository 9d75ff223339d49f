#include "pipeline/sources/disc/pattern_map.h"

#include <gtest/gtest.h>

#include <numbers>

#include "pipeline/image/frame_file.h"
#include "pipeline/sources/disc/disc_pattern.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using std::numbers::pi;

class PatternMaps : public TestFolder {
 protected:
  // A grey picture by column and row, which its file says is in the working space.
  template <class Value>
  MapPattern painted(int width, int height, const Value& value) const {
    FloatImage picture(width, height);
    for (int row = 0; row < height; ++row)
      for (int k = 0; k < width; ++k)
        for (int c = 0; c < 3; ++c) picture.row(row)[3 * k + c] = static_cast<float>(value(k, row));
    MapPattern map{folder_ / "map.exr", 0, 6, 20};
    write_frame(map.file, picture, {});
    return map;
  }

  static double factor(const MapPattern& map, const PatternPlace& at) {
    const std::vector<PatternKind> kinds{map};
    float out = 0;
    DiscPattern(kinds).factors({&at, 1}, {&out, 1});
    return static_cast<double>(out);
  }
};

// Radii go upwards from the inner one, and azimuths to the right from 0.
TEST_F(PatternMaps, HaveTheirPlacesOnTheDisc) {
  const MapPattern map = painted(64, 32, [](int k, int row) { return k + 100 * row; });
  for (const int k : {0, 5, 40, 63})
    for (const int row : {0, 7, 31}) {
      const double r = 20 - 14 * (row + 0.5) / 32, azimuth = 2 * pi * (k + 0.5) / 64;
      EXPECT_NEAR(factor(map, {r, azimuth, 0}), k + 100 * row, 0.5) << k << " " << row;
    }
}

TEST_F(PatternMaps, TurnWithTheGas) {
  MapPattern map = painted(256, 8, [](int k, int) { return k; });
  map.at = 1000;
  const double r = 9, turned = 400 / std::pow(r, 1.5);
  EXPECT_NEAR(factor(map, {r, 1 + std::fmod(turned, 2 * pi), 1400}), factor(map, {r, 1, 1000}),
              0.1);
  EXPECT_GT(std::abs(factor(map, {r, 1, 1400}) - factor(map, {r, 1, 1000})), 5);
}

// What is finer than a footprint is its mean, also where the gas has been wound up for long.
TEST_F(PatternMaps, FadeIntoTheirMean) {
  const MapPattern map =
      painted(300, 100, [](int k, int row) { return (k / 5 + row / 5) % 2 * 2; });
  for (const double azimuth : {0.1, 2.0, 5.0}) {
    EXPECT_NEAR(factor(map, {12, azimuth, 0, 0.01, 7}), 1, 0.1);
    EXPECT_NEAR(factor(map, {12, azimuth, 0, 14, 0.01}), 1, 0.1);
    EXPECT_NEAR(factor(map, {12, azimuth, 1e6, 0.05, 0.01}), 1, 0.1);
  }
}

}  // namespace
}  // namespace domefall
