#include "pipeline/render/rays/azimuth_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace domefall {
namespace {

// Rays of three curves mixed, at the ends of the curves and in between.
TEST(AzimuthBatch, LookUpWhatTheCurvesSay) {
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
      AzimuthBatch sweeps;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const std::size_t c = random() % 3;
        const double low = curves[c].x_min(), high = highest[c], where = part(random);
        sweeps.curve[k] = static_cast<std::int64_t>(c);
        sweeps.x[k] = where < 0.1   ? low
                      : where > 0.9 ? high
                                    : low * std::pow(high / low, part(random));
      }
      look_up(lookups, count, sweeps);
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const OctaveCurve& curve = curves[sweeps.curve[k]];
        EXPECT_EQ(sweeps.value[k], curve.value(sweeps.x[k]));
        const double slope = curve.at(sweeps.x[k]).first;
        EXPECT_NEAR(sweeps.slope[k], slope, 1e-13 * std::abs(slope) + 1e-15);
      }
    }
}

// Beyond the ends it is the ends that are looked up, and nothing outside the curve's memory.
TEST(AzimuthBatch, StayOnTheCurve) {
  const OctaveCurve curve(1e-3, 1.9, [](double x) { return x * x; });
  const OctaveCurve::Lookup lookup = curve.lookup();
  AzimuthBatch sweeps;
  const double off[] = {-1, 0, 1e-9, 1e9, HUGE_VAL, NAN, 1.9000001, 5e-324};
  for (std::size_t k = 0; k < std::size(off); ++k) sweeps.curve[k] = 0, sweeps.x[k] = off[k];
  look_up({lookup, lookup, lookup}, static_cast<int>(std::size(off)), sweeps);
  for (std::size_t k = 0; k < std::size(off); ++k) {
    EXPECT_GE(sweeps.value[k], curve.value(curve.x_min())) << off[k];
    EXPECT_LE(sweeps.value[k], 4 + 1e-9) << off[k];  // of 2, where the last interval ends
  }
}

}  // namespace
}  // namespace domefall
