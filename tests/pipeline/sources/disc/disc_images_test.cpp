// Closed facts of the pictures of a disc, with exact_position as the tracer.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "tests/pipeline/sources/disc/disc_tracer.h"

namespace domefall {
namespace {

constexpr double kPi = std::numbers::pi;
const double kCritical = std::sqrt(27.0);

template <class Function>
double root_of(const Function& f, double low, double high) {
  std::uintmax_t steps = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      f, low, high, boost::math::tools::eps_tolerance<double>(50), steps);
  return (a + b) / 2;
}

// ---- Luminet's isoradials ----

template <class Function>
double integral(const Function& f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(f, from, to, 14, 1e-13);
}

// [Luminet 1979]: the angle that light of impact parameter b sweeps between w = 1/r_o
// and w = 1/r, by way of its periastron P or straight.  With w = 1/P - y^2 the integrand is regular
// at the periastron; where there is none, b < sqrt 27, it is regular anyway.
double swept_angle(double b, double w_o, double w, bool by_way_of_periastron) {
  if (b < kCritical)
    return integral([b](double x) { return 1 / std::sqrt(1 / (b * b) - x * x + 2 * x * x * x); },
                    w_o, w);
  const double periastron = 2 * b / std::sqrt(3) * std::cos(std::acos(-kCritical / b) / 3);
  EXPECT_NEAR(periastron * periastron * periastron / (periastron - 2), b * b, 1e-9 * b * b);
  const double top = 1 / periastron;
  const auto from_periastron = [top](double place) {
    const auto speed = [top](double y) {
      const double s = y * y;
      return 2 / std::sqrt(2 * top - 6 * top * top + s * (6 * top - 1) - 2 * s * s);
    };
    return integral(speed, 0, std::sqrt(std::max(0.0, top - place)));
  };
  return by_way_of_periastron ? from_periastron(w_o) + from_periastron(w)
                              : from_periastron(w_o) - from_periastron(w);
}

// The impact parameter of the light that sets out at r and sweeps that angle to r_o.  It is sought
// by the angle at which the light sets out against -R, as who rests at r sees it.
double impact_parameter(double r, double r_o, double angle) {
  const double most = kCritical * std::sqrt(1 - 2 / r) / r;
  const auto b_of = [r](double set_out) { return r * std::sin(set_out) / std::sqrt(1 - 2 / r); };
  const auto beyond = [&](double set_out) {
    return swept_angle(b_of(set_out), 1 / r_o, 1 / r, set_out > kPi / 2) - angle;
  };
  return b_of(root_of(beyond, 1e-6, kPi - std::asin(most) - 1e-9));
}

TEST(DiscImages, IsoradialsAreThoseOfLuminet) {
  constexpr double kInclination = 80 * kPi / 180, kFar = 1000;
  for (const double r : {6.0, 20.0}) {
    for (int step = 0; step < 12; ++step) {
      const double chi = (step + 0.25) * kPi / 6;
      // The angle from the observer, by [Luminet 1979].
      const double cot = 1 / std::tan(kInclination), c = std::cos(chi);
      const double gamma = std::acos(c / std::hypot(c, cot));
      const double psi = first_crossing(kPlace, tangent_at(chi), normal_at(kInclination));
      ASSERT_NEAR(psi, gamma, 1e-12);
      for (int order = 0; order < 3; ++order) {
        const double b = impact_parameter(r, kFar, gamma + order * kPi);
        const NullRay ray =
            ray_at(kFar, std::asin(b * std::sqrt(1 - 2 / kFar) / kFar), {false, true});
        // A relative error of 1e-13 in b is e^(pi k) times as large in r.
        EXPECT_NEAR(exact_position(ray, psi + order * kPi).value_or(0), r,
                    r * 1e-11 * std::exp(order * kPi))
            << step << " " << order;
      }
    }
  }
}

// ---- photon rings ----

// The angle off the silhouette's edge at which the image of that order shows the radius, face-on.
double offset_of(double at, int order, double r) {
  const double psi = kPi / 2 + order * kPi;
  const auto beyond = [&](double log_offset) {
    const NullRay ray = ray_off_edge(at, Critical::kFirst, std::exp(log_offset));
    return std::log(exact_position(ray, psi).value_or(1e9) / r);
  };
  return std::exp(root_of(beyond, std::log(1e-12), std::log(0.3)));
}

TEST(DiscImages, EachOrderIsThinnerByEToThePi) {
  for (const double at : {8.0, 30.0}) {
    double before = offset_of(at, 1, 20) - offset_of(at, 1, 6);
    for (int order = 2; order <= 6; ++order) {
      const double width = offset_of(at, order, 20) - offset_of(at, order, 6);
      // The sweep at an offset x is -ln x + c + x (a + b ln x), of which the law takes the first
      // two terms.
      EXPECT_NEAR(before / width / std::exp(kPi), 1, 3 * order * std::exp(-kPi * (order - 1)))
          << at << " " << order;
      before = width;
    }
  }
}

}  // namespace
}  // namespace domefall
