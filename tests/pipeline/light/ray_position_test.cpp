#include "pipeline/light/ray_position.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/orbit_cubic.h"
#include "pipeline/light/ray_request.h"
#include "tests/pipeline/light/reference_rays.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

// ---- the same by Jacobi's functions: w = 1/6 + 2 P(sigma) from the singularity ----

// A place on the orbit: w, and sqrt(P) = |dw/dpsi|.
struct OrbitPlace {
  double w, speed;
};

// sigma from the singularity, up to half of the orbit's period.
OrbitPlace from_singularity_three_roots(const Cubic& c, double sigma) {
  const RealRoots w = real_roots(c);
  const double span = w.w1 - w.w3;
  const double modulus = std::sqrt(std::min(1.0, (w.w2 - w.w3) / span));
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(modulus, sigma * std::sqrt(span / 2), &cn, &dn);
  // The distances of w from w3, w1 and w2 are span/sn^2 times 1, cn^2 and dn^2.
  const double scale = span / (sn * sn);
  return {w.w3 + scale, std::sqrt(2 * scale) * scale * std::abs(cn * dn)};
}

OrbitPlace from_singularity_one_root(const Cubic& c, double sigma) {
  const OneRealRoot p = one_real_root(c.eps);
  const double height = std::hypot(p.root - p.m, p.n);
  const double square = 0.5 - 0.75 * (p.root + 1.0 / 6) / height;
  const double modulus = std::sqrt(std::min(1.0, square));
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(modulus, sigma * std::sqrt(2 * height), &cn, &dn);
  // (1 + cn)/(1 - cn), from whichever of the two does not cancel.
  const double ratio = cn >= 0 ? (1 + cn) / sn * ((1 + cn) / sn) : sn / (1 - cn) * (sn / (1 - cn));
  const double above_root = height * ratio, x = p.root + above_root;
  return {1.0 / 3 + x, std::sqrt(2 * above_root) * std::hypot(x - p.m, p.n)};
}

OrbitPlace from_singularity(const Cubic& c, double sigma) {
  return c.eps < 0 ? from_singularity_three_roots(c, sigma) : from_singularity_one_root(c, sigma);
}

double radius_from_sky(const Cubic& c, double rho) {
  const double e = std::sqrt(c.inverse_b2);
  const OrbitPlace s = from_singularity(c, rho);
  return s.w / e * (s.w / (e + s.speed));
}

// On a path to its end, without the half that leads to a turning point.
double by_jacobi(const NullRay& ray, double psi) {
  const Cubic c = cubic_of(ray.at, invariants(ray));
  const double left = exact_azimuth(ray) - psi;
  return origin_of(ray) == SkyRegion::kIV ? 1 / from_singularity(c, left).w
                                          : radius_from_sky(c, left);
}

TEST(RayPosition, IsThatByJacobisFunctions) {
  const int steps = tries(40, 8);
  for (const bool outgoing : {false, true})
    for (const double r : {1e-3, 0.5, 1.9, 2.1, 2.9, 3.2, 10.0, 1e5})
      for (int i = 1; i < steps; ++i) {
        const NullRay ray = ray_at(r, std::numbers::pi * i / steps, {outgoing, false});
        const double phi = exact_azimuth(ray);
        // Next to an edge the functions' modulus is 1 but for what a double cannot hold.
        if (smooth_over(ray) < 1e-3 || std::abs(ray.gap_second) < 1e-3) continue;
        for (const double part : {0.5, 0.7, 0.9, 0.99}) {
          const double exact = by_jacobi(ray, part * phi);
          EXPECT_NEAR(exact_position(ray, part * phi).value_or(0) / exact, 1, 1e-11)
              << outgoing << " " << r << " " << alpha_of(ray) << " " << part;
        }
      }
}

TEST(RayPosition, IsThatOfTheReferenceRows) {
  int rows = 0;
  for (const auto& [line, r, delta, psi, there] : reference_places()) {
    const RayRequest ray = ray_at_angle(TraceObserver::kRain, decimal_radius(r), delta);
    // The closed form, what renders, and integrators that share nothing with either.
    const struct {
      TraceMethod method;
      double tolerance, error;
    } ways[] = {{TraceMethod::kExact, 0, 1e-10},        {TraceMethod::kTable, 0, 1e-10},
                {TraceMethod::kPaperRk4, 1e-9, 1e-6},   {TraceMethod::kFullDopri5, 1e-11, 1e-6},
                {TraceMethod::kFullRkf78, 1e-11, 1e-6}, {TraceMethod::kBinetDopri5, 1e-11, 1e-6},
                {TraceMethod::kBinetRkf78, 1e-11, 1e-6}};
    for (const auto& way : ways) {
      if (is_integrator(way.method) && rows % tries(4, 40) != 0) continue;
      TraceOptions options;
      options.tolerance = way.tolerance;
      const auto found = trace_place(ray, psi, way.method, options);
      ASSERT_TRUE(found) << line;
      EXPECT_NEAR(found->r / there, 1, way.error) << line << " " << static_cast<int>(way.method);
    }
    ++rows;
  }
  EXPECT_EQ(rows, 224);
}

TEST(RayPosition, OfARadialRayEndsAtOnceAndOfACriticalOneNever) {
  EXPECT_EQ(exact_position(ray_at(10, 0), 0), 10);
  EXPECT_FALSE(exact_position(ray_at(10, 0), 1e-9));
  for (const double r : {0.5, 2.0, 2.5, 3.0, 10.0})
    EXPECT_NEAR(exact_position(ray_off_edge(r, Critical::kFirst, 0), 200).value_or(0), 3, 1e-9);
}

}  // namespace
}  // namespace domefall
