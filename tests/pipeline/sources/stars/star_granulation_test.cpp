#include "pipeline/sources/stars/star_granulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace domefall {
namespace {

constexpr double kContrast = 0.12;

// The mean and the standard deviation over places that are even on the sphere.
std::pair<double, double> statistics(double width) {
  constexpr int kPlaces = 300000;
  double sum = 0, squares = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const double z = (2 * k + 1.0) / kPlaces - 1, turn = k * 2.399963229728653;
    const double across = std::sqrt(1 - z * z);
    const V3d place(across * std::cos(turn), across * std::sin(turn), z);
    const double light = granulation(place, width, kContrast);
    sum += light, squares += light * light;
  }
  const double mean = sum / kPlaces;
  return {mean, std::sqrt(squares / kPlaces - mean * mean)};
}

TEST(StarGranulation, KeepsTheLightOfTheStar) {
  for (const double width : {0.0, kGranule / 4, kGranule / 2, kMottling / 4})
    EXPECT_NEAR(statistics(width).first, 1, 1e-3) << width;
}

TEST(StarGranulation, HasTheContrastOfItsGranulesAndAFainterMottling) {
  const auto [mean, fine] = statistics(0);
  EXPECT_NEAR(fine, kContrast, 0.012);
  const auto [again, coarse] = statistics(kGranule);
  EXPECT_GT(coarse, 0.1 * kContrast);
  EXPECT_LT(coarse, kContrast / 3);
}

TEST(StarGranulation, IsEvenWhereItIsNotResolved) {
  for (int k = 0; k < 1000; ++k) {
    const V3d place = V3d(std::cos(k), std::sin(k), std::cos(0.3 * k)).normalized();
    EXPECT_EQ(granulation(place, kMottling, kContrast), 1);
    // Details fade without a step as a star goes away.
    double before = granulation(place, 0, kContrast);
    for (double width = 0; width < kMottling; width += kGranule / 100) {
      const double now = granulation(place, width, kContrast);
      EXPECT_NEAR(now, before, 0.02);
      before = now;
    }
  }
}

TEST(StarGranulation, HasNoSeams) {
  for (const V3d& pole : {V3d(0, 0, 1), V3d(0, 0, -1), V3d(-1, 0, 0)})
    for (int k = 0; k < 200; ++k) {
      const V3d aside = V3d(std::cos(k), std::sin(k), std::sin(2.0 * k)) * (2e-3 * k),
                step = V3d(std::sin(k), std::cos(k), std::cos(3.0 * k)) * (0.002 * kGranule);
      EXPECT_NEAR(granulation((pole + aside).normalized(), 0, kContrast),
                  granulation((pole + aside + step).normalized(), 0, kContrast), 0.02);
    }
}

}  // namespace
}  // namespace domefall
