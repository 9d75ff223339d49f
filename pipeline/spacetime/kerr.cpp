#include "pipeline/spacetime/kerr.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace domefall {

namespace {

// Returns ln|(r - r_+)/(r - r_-)|/(r_+ - r_-), which tends to -1/(r - r_-) as the horizons become one.
long double log_of_ratio(const KerrHole& hole, long double r) {
  const long double d = hole.horizon_distance(), above_inner = (r - 1) + d;
  const long double x = 2 * d / above_inner;
  const long double log = x < 0.5L ? std::log1p(-x) : std::log(std::abs((r - 1) - d) / above_inner);
  return log / (2 * d);
}

}  // namespace

long double KerrHole::twist(long double r) const { return spin * log_of_ratio(*this, r); }

// r^2 + a^2 = Delta + 2r - q^2, and the parts of the rest sum up to 2.
long double KerrHole::tortoise(long double r) const {
  return r + 2 * std::log(std::abs((r - 1) + horizon_distance())) +
         (horizon() * horizon() + spin * spin) * log_of_ratio(*this, r);
}

double kerr_light_circle(const KerrHole& hole, bool prograde) {
  const auto a = static_cast<double>(prograde ? hole.spin : -hole.spin);
  const auto q2 = static_cast<double>(hole.charge * hole.charge);
  // By Newton's method from outside, which comes to the outermost root from above.
  double r = 4.5;
  for (int k = 0; k < 60; ++k) {
    const double w = std::sqrt(r - q2), over = r * r - 3 * r + 2 * q2 + 2 * a * w;
    const double next = r - over / (2 * r - 3 + a / w);
    if (!(next < r)) break;
    r = next;
  }
  return r;
}

std::optional<KerrCircle> kerr_circle(const KerrHole& hole, double r, bool prograde) {
  const auto a = static_cast<double>(prograde ? hole.spin : -hole.spin);
  const auto q2 = static_cast<double>(hole.charge * hole.charge);
  if (r <= q2) return std::nullopt;
  const double w = std::sqrt(r - q2), square = r * r - 3 * r + 2 * q2 + 2 * a * w;
  // Within both circles of light the square may be positive again, where no orbit is.
  if (!(square > 0 && hole.delta(r) > 0 && r > hole.horizon())) return std::nullopt;
  const double n = r * std::sqrt(square);
  return KerrCircle{(r * r + a * w) / n, (prograde ? w : -w) / n};
}

double last_stable_circle(const KerrHole& hole, bool prograde) {
  const auto a = static_cast<double>(prograde ? hole.spin : -hole.spin);
  const auto q2 = static_cast<double>(hole.charge * hole.charge);
  const auto stable = [&](double r) {
    const double w = std::sqrt(r - q2);
    return r * (6 * r - r * r - 9 * q2 + 3 * a * a) + 4 * q2 * (q2 - a * a) - 8 * a * w * w * w;
  };
  // The circle is the outermost zero, beyond which this is negative.
  double in = static_cast<double>(hole.horizon()), out = 9.5;
  if (q2 == 0) {
    const double z1 = 1 + std::cbrt((1 - a) * (1 + a)) * (std::cbrt(1 + a) + std::cbrt(1 - a));
    const double z2 = std::sqrt(3 * a * a + z1 * z1);
    const double root = std::sqrt((3 - z1) * (3 + z1 + 2 * z2));
    return 3 + z2 - std::copysign(root, a);
  }
  while (true) {
    const double middle = (in + out) / 2;
    if (!(middle > in && middle < out)) return middle;
    (stable(middle) < 0 ? out : in) = middle;
  }
}

double page_thorne_flux(const KerrHole& hole, double r, bool prograde) {
  constexpr double kThird = std::numbers::pi / 3;
  const auto a = static_cast<double>(prograde ? hole.spin : -hole.spin);
  const double first = last_stable_circle(hole, prograde);
  if (r <= first) return 0;
  const double y = std::sqrt(r), y0 = std::sqrt(first), angle = std::acos(a) / 3;
  const std::array<double, 3> root{2 * std::cos(angle - kThird), 2 * std::cos(angle + kThird),
                                   -2 * std::cos(angle)};
  double sum = y - y0 - 1.5 * a * std::log(y / y0);
  for (std::size_t i = 0; i < 3; ++i) {
    const double yi = root[i], yj = root[(i + 1) % 3], yk = root[(i + 2) % 3];
    if (std::abs(yi) < 1e-12) continue;  // without spin, where its term is 0
    sum -= 3 * (yi - a) * (yi - a) / (yi * (yi - yj) * (yi - yk)) * std::log((y - yi) / (y0 - yi));
  }
  const double y2 = y * y;
  return 1.5 * sum / (y2 * y2 * (y * (y2 - 3) + 2 * a));
}

}  // namespace domefall
