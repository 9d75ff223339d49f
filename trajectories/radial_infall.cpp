#include "trajectories/radial_infall.h"

#include <cmath>
#include <numbers>

namespace domefall {
namespace {

// Returns int dr/(s (1 + s)) with s = sqrt(2/r) = 1/x, because dv = -dr/(s (1 + s)) along the fall.
double fallen_null_time(double r) {
  const double x = std::sqrt(r / 2);
  return 4 * (x * (1 + x * (x / 3 - 0.5)) - std::log1p(x));
}

}  // namespace

double RadialInfall::death() const {
  const double a = from_r;
  return std::numbers::sqrt2 / 3 * a * (a * a) / (a * std::sqrt(a));
}

ProperTime proper_time_to(const RadialInfall& fall, double r) {
  const double a = fall.from_r;
  const double left = std::numbers::sqrt2 / 3 * r * std::sqrt(r), all = fall.death();
  if (left < all / 2) return ProperTime(all) - left;
  return std::numbers::sqrt2 / 3 * (a - r) * (a * a + a * r + r * r) /
         (a * std::sqrt(a) + r * std::sqrt(r));
}

std::optional<ProperTime> RadialInfall::time_at(double r, Leg leg, const ProperTime& after) const {
  if (leg == Leg::kOutward || r > from_r) return std::nullopt;
  const ProperTime tau = proper_time_to(*this, r);
  return tau >= after ? std::optional(tau) : std::nullopt;
}

OrbitPoint RadialInfall::at(const ProperTime& tau) const {
  constexpr double kPerTime = 3 / std::numbers::sqrt2;
  const double left = double(death() - tau);
  const double root = std::cbrt(
      left < double(tau) ? kPerTime * left : from_r * std::sqrt(from_r) - kPerTime * double(tau));
  const double r = root * root;
  return {r > 2 ? Region::kI : Region::kII,
          Tetrad::kRain,
          r,
          0,
          {},
          DoubleDouble(fallen_null_time(from_r)) - fallen_null_time(r)};
}

}  // namespace domefall
