#include "pipeline/light/azimuth_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace domefall {
namespace {

// The rays of three curves are mixed, and lie at the ends of the curves and in between.
TEST(AzimuthBatch, HasTheValuesAndSlopesOfTheCurves) {
  const OctaveCurve curves[3] = {OctaveCurve(1e-7, 2, [](double x) { return -std::log(x) + x; }),
                                 OctaveCurve(1e-3, 0.9, [](double x) { return std::sin(x); }),
                                 OctaveCurve(
                                     1e-12, 30, [](double x) { return std::atan(x); }, 4)};
  const std::array<OctaveCurve::Lookup, 3> lookups{curves[0].lookup(), curves[1].lookup(),
                                                   curves[2].lookup()};
  const double highest[3] = {2, 0.9, 30};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  for (const int count : {1, 6, AzimuthBatch::kSize})
    for (int round = 0; round < 100; ++round) {
      AzimuthBatch batch;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const std::size_t c = random() % 3;
        const double low = curves[c].x_min(), high = highest[c], where = part(random);
        batch.curve[k] = static_cast<std::int64_t>(c);
        batch.x[k] = where < 0.1   ? low
                     : where > 0.9 ? high
                                   : low * std::pow(high / low, part(random));
      }
      find_azimuths(lookups, count, batch);
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const OctaveCurve& curve = curves[batch.curve[k]];
        EXPECT_EQ(batch.azimuth[k], curve.value(batch.x[k]));
        const double slope = curve.at(batch.x[k]).first;
        EXPECT_NEAR(batch.slope[k], slope, 1e-13 * std::abs(slope) + 1e-15);
      }
    }
}

// Coordinates outside the curve count as its ends: nothing beside its memory is read.
TEST(AzimuthBatch, StaysOnTheCurve) {
  const OctaveCurve curve(1e-3, 1.9, [](double x) { return x * x; });
  const OctaveCurve::Lookup lookup = curve.lookup();
  AzimuthBatch batch;
  const double off[] = {-1, 0, 1e-9, 1e9, HUGE_VAL, NAN, 1.9000001, 5e-324};
  for (std::size_t k = 0; k < std::size(off); ++k) {
    batch.curve[k] = 0;
    batch.x[k] = off[k];
  }
  find_azimuths({lookup, lookup, lookup}, static_cast<int>(std::size(off)), batch);
  for (std::size_t k = 0; k < std::size(off); ++k) {
    EXPECT_GE(batch.azimuth[k], curve.value(curve.x_min())) << off[k];
    EXPECT_LE(batch.azimuth[k], 4 + 1e-9)
        << off[k];  // the square of 2, where the last interval ends
  }
}

}  // namespace
}  // namespace domefall
