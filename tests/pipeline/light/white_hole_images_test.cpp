// Images of points of the past singularity: where they stand, how large, and what happens where two
// of them merge.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/hole_optics.h"

namespace domefall {
namespace {

using std::numbers::pi;

V3d at_azimuth(double phi) { return {std::cos(phi), std::sin(phi), 0}; }

// The angle from -R in rain, from +R in the outgoing frame.
double alpha_of_image(const TetradDirection& d, bool outgoing) {
  return std::atan2(std::hypot(d.v.y, d.v.z), outgoing ? d.v.x : -d.v.x);
}

struct StarPlace {
  double r;
  bool outgoing;
};

TEST(WhiteHoleImages, StandWhereTheExactIntegralSaysWithItsAmplification) {
  for (const StarPlace& p :
       {StarPlace{0.5, false}, StarPlace{1.9, false}, StarPlace{2.5, false}, StarPlace{20, false},
        StarPlace{0.5, true}, StarPlace{1.9, true}, StarPlace{2.5, true}, StarPlace{20, true}}) {
    const WhiteHoleTable table(p.r, p.outgoing);
    for (const double phi_star : {0.3, 1.2, 2.5})
      for (int order = 0; order < 5; ++order) {
        const double phi = order % 2 == 0 ? phi_star + order * pi : (order + 1) * pi - phi_star;
        const WhiteHoleImages images = images_of(table, at_azimuth(phi_star), order, 1e-9);
        for (int k = 0; k < images.count; ++k) {
          const SkyImage& image = images.image[static_cast<std::size_t>(k)];
          const double alpha = alpha_of_image(image.direction, p.outgoing);
          const NullRay ray = ray_at(p.r, alpha, {p.outgoing, false});
          const double slope = exact_slope(ray);
          EXPECT_NEAR(exact_azimuth(ray), phi, 1e-9 * (1 + std::abs(slope))) << p.r << " " << phi;
          // On the source's side for even orders, opposite for odd ones.
          EXPECT_EQ(image.direction.v.y > 0, order % 2 == 0);
          const double expected = std::sin(alpha) / std::abs(std::sin(phi) * slope);
          EXPECT_NEAR(image.amplification / expected, 1, 1e-5) << p.r << " " << phi;
        }
        const bool outside = p.r > 2;
        const double extremum = outside ? 0 : table.turn()->azimuth;
        const bool seen = outside || (p.outgoing ? phi < extremum : phi > extremum);
        EXPECT_EQ(images.count, !seen ? 0 : outside ? 1 : 2);
      }
  }
}

// Where two images merge each alone is amplified without bound; a source of finite size is not: the
// mean over its disc stays below what is stated for its middle, and of the same order.
TEST(WhiteHoleImages, MergeOnTheCausticWithABoundedAmplification) {
  const WhiteHoleTable table(1.2, false);
  const double fold = table.turn()->azimuth;
  for (const double size : {1e-3, 1e-5, 1e-7}) {
    const auto total = [&](double phi, double blur) {
      const WhiteHoleImages images = images_of(table, at_azimuth(2 * pi - phi), 1, blur);
      double sum = 0;
      for (int k = 0; k < images.count; ++k)
        sum += images.image[static_cast<std::size_t>(k)].amplification;
      return sum;
    };
    const double bounded = total(fold + 1e-3 * size, size);
    EXPECT_TRUE(std::isfinite(bounded));
    // The mean over the strip of the source's width, of which a half lies beyond the fold and is
    // dark: substituting phi = fold + t^2 makes the integrand smooth.
    double mean = 0;
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) {
      const double t = std::sqrt(size) * (k + 0.5) / steps;
      mean += total(fold + t * t, 1e-15) * 2 * t * std::sqrt(size) / steps / (2 * size);
    }
    EXPECT_GT(bounded / mean, 0.5) << size;
    EXPECT_LT(bounded / mean, 2) << size;
  }
}

}  // namespace
}  // namespace domefall
