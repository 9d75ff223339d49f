#include "pipeline/light/emission_time.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <limits>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/square.h"

namespace domefall {
namespace {

const double kSqrt3 = std::sqrt(3.0);

// Above this 1/b the form b (phi - K) is used.  Below it, where that is a difference of large
// numbers, the form with the pole at the horizon taken out is used.
constexpr double kLargeInverseB = 0.1;
constexpr double kJustBelowHorizon = -1e-20;

// A Path is a ray of E >= 0 from the singularity.
struct Path {
  Radius at;
  double e;    // E/L = 1/b
  double eps;  // e^2 - 1/27
  double p;    // P at the observer, (k^r/L)^2
  bool turned;
};

// Integrates over a unit interval.  The rule's nodes crowd towards the ends, and those of a short
// interval far from 0 would fall on them.
template <class F>
double integral(double from, double to, F f) {
  thread_local boost::math::quadrature::tanh_sinh<double> rule(12);
  if (!(from < to)) return 0;
  const double width = to - from;
  const auto unit = [&](double t) { return f(from + width * t); };
  return width * rule.integrate(unit, 0.0, 1.0, 1e-13);
}

// ---- K where the path passes every radius, eps >= 0 ----

// The integral is taken in w from the observer to the light circle, and in q = sqrt(r) from there
// to the singularity:
//   int 2 b dq/(q^3 + b sqrt(q^6 P)),  q^6 P = (1 - q^2/3)^2 (2 + q^2/3) + eps q^6.
double bounded_part_over_circle(const Path& path) {
  const double b = 1 / path.e, eps = path.eps, end = std::min(std::sqrt(path.at.r), kSqrt3);
  const auto beyond = [=](double w) {
    const double x = w - 1.0 / 3;
    return b / (1 + b * std::sqrt(x * x * (1 + 2 * x) + eps));
  };
  const auto within = [=](double q) {
    const double third = q * q / 3, cube = q * q * q;
    return 2 * b / (cube + b * std::sqrt(square(1 - third) * (2 + third) + eps * cube * cube));
  };
  const double bend = std::min(end, std::cbrt(std::sqrt(2.0) * b));
  const double far = path.at.r > 3 ? integral(1 / path.at.r, 1.0 / 3, beyond) : 0;
  return far + integral(0, bend, within) + integral(bend, end, within);
}

// ---- a path that has a turning point w1 > 1/3, eps < 0, on it or not ----

// P = (w - w1) Q with Q = 2 x^2 + (1 + 2 x1) (x + x1) and x = w - 1/3 has positive terms only.
struct Turning {
  double x1, w1;
  double y_observer;  // sqrt(w - w1)

  double q(double x) const { return 2 * x * x + (1 + 2 * x1) * (x + x1); }
};

Turning turning_of(const Path& path) {
  const double u = 2.0 / 3 * std::atan2(std::sqrt(-path.eps), path.e);
  const double s = std::sin(u / 2);
  Turning t{};
  t.x1 = s * (std::cos(u / 2) / kSqrt3 - s / 3);
  t.w1 = 1.0 / 3 + t.x1;
  t.y_observer = std::sqrt(path.p / t.q(-path.at.above_light_circle / (3 * path.at.r)));
  return t;
}

// Integrates f(y) dy from `from` to infinity in two halves.  One has f over y < 1, and the other
// `far`, the same times dy/dz, over z = 1/y.
template <class Rule, class Near, class Far>
double to_infinity(Rule rule, double from, Near near, Far far) {
  return from < 1 ? rule(from, 1.0, near) + rule(0.0, 1.0, far) : rule(0.0, 1 / from, far);
}

// Returns K from y = `from` (w = w1 + y^2) to the singularity.
double bounded_part_from(const Path& path, const Turning& t, double from) {
  const double b = 1 / path.e, x1 = t.x1;
  const auto near = [=](double y) { return 2 * b * y / (1 + b * y * std::sqrt(t.q(x1 + y * y))); };
  const auto far = [=](double z) {
    const double z2 = z * z;
    const double z4q = 2 * square(1 + x1 * z2) + (1 + 2 * x1) * z2 * (1 + 2 * x1 * z2);
    return 2 * b / (z * z2 + b * std::sqrt(z4q));
  };
  const auto rule = [](double low, double high, auto f) { return integral(low, high, f); };
  return to_infinity(rule, from, near, far);
}

double bounded_part(const Path& path, const Turning& t) {
  const double beyond = bounded_part_from(path, t, t.y_observer);
  return path.turned ? 2 * bounded_part_from(path, t, 0) - beyond : beyond;
}

// ---- b large: t itself, its pole at the horizon taken out ----

// With w = w1 + y^2 and y0^2 = 1/2 - w1, dt = e dw/(w^2 (1 - 2w) sqrt(P)) = e g(w) dy/(y0^2 - y^2),
// where g = 1/(w^2 sqrt(Q)) and g = 4 y0/e on the pole.  The principal value of the pole alone is a
// logarithm.  This is the rest, (g - g(1/2))/(1/2 - w), from y = `from`, with G = w^4 Q,
// g = 1/sqrt(G), and the quotient of the polynomial G divided out.
double without_pole(const Turning& t, double y0, double from) {
  const auto divided = [](double w, int power) {  // (w^n - 2^-n)/(w - 1/2)
    double sum = 0, half = 1;
    for (int k = 0; k < power; ++k, half /= 2) sum = sum * w + half;
    return sum;
  };
  const double y02 = y0 * y0, w1 = t.w1;
  const auto root_g = [&](double w) { return w * w * std::sqrt(t.q(w - 1.0 / 3)); };
  const double at_pole = root_g(0.5);
  const auto near = [&](double y) {
    const double w = w1 + y * y, root = root_g(w);
    const double quotient = 2 * divided(w, 6) - 2 * y02 * (divided(w, 5) + w1 * divided(w, 4));
    return quotient / (root * at_pole * (root + at_pole));
  };
  const auto far = [&](double z) { return near(1 / z) / (z * z); };
  // The integrand is analytic, with nothing nearer than |y| = 0.6 to the path.
  const auto rule = [](double low, double high, auto f) {
    return boost::math::quadrature::gauss<double, 30>::integrate(f, low, high);
  };
  return to_infinity(rule, from, near, far);
}

double time_of_small_energy(const Path& path, const Turning& t) {
  const double y0 = path.e / std::sqrt(t.q(1.0 / 6)), y = t.y_observer, r = path.at.r;
  // -r* is in the logarithm: (y0^2 - y^2) is (r - 2)/(2 r).
  const double logarithm = 4 * std::log(y0 + y) + 2 * std::log(r) + r;
  const double rest = without_pole(t, y0, y);
  if (!path.turned) return logarithm - path.e * rest;
  return path.e * (rest - 2 * without_pole(t, y0, 0)) - logarithm;
}

// Returns t at emission from u at the observer, or from v if the ray has turned.
double time_from_null_coordinate(const Path& path, double azimuth) {
  if (path.eps >= 0) return -(azimuth - bounded_part_over_circle(path)) / path.e;
  const Turning t = turning_of(path);
  if (path.e < kLargeInverseB) return time_of_small_energy(path, t);
  const double swept = -(azimuth - bounded_part(path, t)) / path.e;
  if (!path.turned) return swept;
  const double below = square(path.e) / t.q(1.0 / 6);  // 1/2 - w1
  return swept - 2 * (1 / t.w1 + 2 * std::log(below / t.w1));
}

}  // namespace

double exact_emission_time(const NullRay& ray) {
  const RayInvariants k = invariants(ray);
  Radius at = ray.at;
  if (at.above_horizon == 0) at.above_horizon = kJustBelowHorizon;
  const double l = k.angular_momentum, sign = k.energy < 0 ? -1 : 1;
  if (circles_for_ever(ray)) return -sign * std::numeric_limits<double>::infinity();
  const bool inside = at.above_horizon < 0;
  const bool turned = inside ? !ray.outgoing : k.radial < 0;
  double time = 0;  // of a radial ray
  if (l > 0) {
    const Path path{at, std::abs(k.energy) / l, (k.below_critical / l) * (k.above_critical / l),
                    square(k.radial / l), turned};
    time = time_from_null_coordinate(path, exact_azimuth(ray));
  }
  const double own = turned ? Schwarzschild::tortoise(at)
                            : -Schwarzschild::tortoise(at);  // the null coordinate minus t
  const double wanted = ray.outgoing ? -Schwarzschild::tortoise(at) : Schwarzschild::tortoise(at);
  // Where they are one, r* may be infinite.
  if (sign > 0) return turned != ray.outgoing ? time : time + own - wanted;
  return -(time + own) - wanted;
}

}  // namespace domefall
