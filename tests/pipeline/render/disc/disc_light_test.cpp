// No light of a disc is lost or made on its way into pixels, however thin its images are.
#include "pipeline/sources/disc/disc_light.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <vector>

#include "pipeline/light/aberration.h"
#include "pipeline/light/ray_position.h"
#include "tests/pipeline/render/disc/disc_views.h"

namespace domefall {
namespace {

// All light of a disc that reaches an observer, by quadrature over its exact images: the rims of
// each by inverting exact_position, and between them the places of rays by the same.  It shares the
// formulas of the gas's shift and colour with the renderer, and no table of rays.
class ExactDiscLight {
 public:
  explicit ExactDiscLight(const DiscView& view)
      : view_(view),
        normal_(view.normal.normalized()),
        up_(normal_.x),
        across_(std::hypot(normal_.y, normal_.z)),
        azimuth_(std::atan2(normal_.z, normal_.y)),
        outgoing_(is_outgoing(view.at.tetrad)),
        light_(view.disc) {}

  // Lux.  Rays are sorted by the angle chi about R at which the normal's part across R is met: the
  // angle to the disc's plane along them changes near chi = +-pi/2 alone if the plane is near.
  double illuminance() const {
    using std::numbers::pi;
    const double scale = std::atan2(std::abs(up_) + 1e-9, across_);
    const double most = std::asinh(pi / 2 / scale);
    const int panels = std::max(4, static_cast<int>(std::ceil(2 * most)));
    double sum = 0;
    for (const double side : {-1.0, 1.0})
      for (int k = 0; k < panels; ++k)
        sum += Nodes::integrate(
            [&](double t) {
              const double chi = azimuth_ + side * (pi / 2 + scale * std::sinh(t));
              return scale * std::cosh(t) * in_plane(chi);
            },
            -most + 2 * most * k / panels, -most + 2 * most * (k + 1) / panels);
    return sum;
  }

 private:
  using Nodes = boost::math::quadrature::gauss<double, 20>;
  static constexpr int kOrders = 4;

  struct Images {
    double psi;  // of order 0
    std::array<double, kOrders> inner, outer;
  };

  NullRay ray_from_hole(double delta) const {
    const PolarAngle angle = polar_angle(static_cast<long double>(delta));
    return ray_at(view_.at.r, outgoing_ ? angle.reversed() : angle, {outgoing_, false});
  }
  double least_angle() const {  // of E > 0
    const double s = std::sqrt(2 / view_.at.r);
    return s > 1 && !outgoing_ ? std::acos(1 / s) : 0;
  }

  // The angle from the hole at which a ring is seen after psi: r grows with it.
  double angle_of(double ring, double psi) const {
    const auto beyond = [&](double delta) {
      const NullRay ray = ray_from_hole(delta);
      const auto r = exact_position(ray, psi);
      const double w = r ? 1 / *r : origin_of(ray) == SkyRegion::kIV ? 1e3 : 0;
      return std::min(w, 2.0) - 1 / ring;
    };
    std::uintmax_t steps = 100;
    const auto [a, b] =
        boost::math::tools::toms748_solve(beyond, least_angle() + 1e-12, std::numbers::pi - 1e-12,
                                          boost::math::tools::eps_tolerance<double>(42), steps);
    return (a + b) / 2;
  }

  // The light between two directions of one chi, per angle of chi.
  double in_plane(double chi) const {
    const V3d tangent(0, std::cos(chi), std::sin(chi));
    Images images;
    images.psi = std::atan2(-up_, normal_.dot(tangent));
    if (!(images.psi > 0)) images.psi += std::numbers::pi;
    std::vector<double> rims;
    for (int order = 0; order < kOrders; ++order) {
      const double psi = images.psi + order * std::numbers::pi;
      const auto k = static_cast<std::size_t>(order);
      rims.push_back(images.inner[k] = angle_of(view_.disc.inner, psi));
      rims.push_back(images.outer[k] = angle_of(view_.disc.outer, psi));
    }
    std::sort(rims.begin(), rims.end());
    double sum = 0;
    for (std::size_t k = 1; k < rims.size(); ++k) {
      if (!(rims[k] > rims[k - 1])) continue;
      sum += Nodes::integrate([&](double delta) { return along(delta, tangent, images); },
                              rims[k - 1], rims[k]);
    }
    return sum;
  }

  double along(double delta, const V3d& tangent, const Images& images) const {
    const V3d direction = V3d(-std::cos(delta), 0, 0) + tangent * std::sin(delta);
    const double received = to_observer(view_.at.celerity, direction).frequency_ratio;
    const NullRay ray = ray_from_hole(delta);
    const GasRay disc = disc_ray(invariants(ray), V3d(1, 0, 0), tangent, normal_);
    double sum = 0, left = 1;
    for (std::size_t k = 0; k < kOrders; ++k) {
      if (delta < images.inner[k] || delta > images.outer[k]) continue;
      const double psi = images.psi + static_cast<double>(k) * std::numbers::pi;
      const double r = exact_position(ray, psi).value_or(0);
      if (r < 2) continue;
      const bool outward = exact_position(ray, psi + 1e-6).value_or(1e300) < r;
      sum += left * view_.disc.opacity *
             luminance(light_.light(r, received / disc_shift(GasOrbits(), disc, r, outward)));
      left *= 1 - view_.disc.opacity;
    }
    return sum * std::sin(delta) / (received * received);
  }

  DiscView view_;
  V3d normal_;
  double up_, across_, azimuth_;
  bool outgoing_;
  DiscLight light_;
};

constexpr Region kI = Region::kI;
constexpr Tetrad kRain = Tetrad::kRain;

Disc ring(double inner, double outer, double opacity) {
  return {.inner = inner, .outer = outer, .opacity = opacity};
}

void expect_all_light(const DiscView& view, const Projection& projection, double tolerance) {
  const Show show = disc_show(view, projection);
  const double exact = ExactDiscLight(view).illuminance();
  ASSERT_GT(exact, 0);
  EXPECT_NEAR(illuminance(show, render_floats(show)) / exact, 1, tolerance);
}

Projection flat_image(int size, double degrees) {
  return Stereographic{size, size, degrees * kDegree};
}

DiscView from_afar(double degrees, const Disc& disc) {
  return {{kI, kRain, 60, celerity_of_rest(60)}, normal_seen_from(degrees), disc};
}

TEST(DiscLight, OfARingSeenFromAboveIsThatOfItsExactImages) {
  expect_all_light(from_afar(60, ring(9, 11, 1)), flat_image(256, 50), 2e-4);
}

TEST(DiscLight, OfARingWithAllItsImagesIsThatOfItsExactImages) {
  expect_all_light(from_afar(10, ring(9, 11, 0.5)), flat_image(256, 50), 4e-4);
  expect_all_light(from_afar(10, ring(6, 20, 1)), flat_image(256, 50), 4e-4);
}

// Rings narrower than a pixel: the pixels of this image are as wide as 0.2 M there.
TEST(DiscLight, IsKeptWhereARingIsNarrowerThanAPixel) {
  expect_all_light(from_afar(35, ring(10, 10.1, 0.8)), flat_image(256, 50), 1e-3);
}

// The direct image is a line of a third of a pixel, and less.
TEST(DiscLight, IsKeptOnEdge) {
  const Disc disc = ring(6, 20, 1);
  const Projection projection = flat_image(192, 50);
  for (const double degrees : {0.2, 0.01}) {
    SCOPED_TRACE(degrees);
    expect_all_light(from_afar(degrees, disc), projection, 1e-3);
  }
  // In the plane itself the line has no light, and all else is as next to it: the light changes by
  // 1.6 per mille in a hundredth of a degree.
  const double beside = ExactDiscLight(from_afar(0.01, disc)).illuminance();
  for (const double degrees : {1e-5, 0.0, -1e-9}) {
    const Show show = disc_show(from_afar(degrees, disc), projection);
    EXPECT_NEAR(illuminance(show, render_floats(show)) / beside, 1, 3e-3) << degrees;
  }
}

// Pixels of images of the whole sphere are 0.7 degrees wide here.  What they err by falls with
// their size.
constexpr double kOfTheSphere = 8e-4;

// From among the gas, above it by more or less than a pixel's angle.
TEST(DiscLight, IsKeptWithinTheDisc) {
  for (const double degrees : {20.0, 0.3}) {
    SCOPED_TRACE(degrees);
    expect_all_light(
        {{kI, kRain, 10, celerity_of_rest(10)}, normal_seen_from(degrees), ring(6, 20, 1)},
        Equirectangular{512}, kOfTheSphere);
  }
}

TEST(DiscLight, IsKeptForFastObservers) {
  expect_all_light({{kI, kRain, 25, {0.5, 0.8, -1}}, V3d(0.3, -0.8, 0.4), ring(6, 20, 0.9)},
                   Equirectangular{512}, kOfTheSphere);
}

TEST(DiscLight, IsKeptBetweenDiscAndHoleAndBehindTheHorizon) {
  for (const double r : {4.0, 2.0, 1.0, 0.8})
    expect_all_light(
        {{r > 2 ? kI : Region::kII, kRain, r, {0, 0, 0}}, V3d(0.5, -1, 0), ring(6, 20, 0.9)},
        Equirectangular{512}, kOfTheSphere);
}

}  // namespace
}  // namespace domefall
