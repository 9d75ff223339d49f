#include "pipeline/spacetime/kruskal.h"

#include <boost/math/special_functions/lambert_w.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace domefall {
namespace {

// Returns x = r - 2 from c = ln(-U V) + 1 = ln(x/2) + 1 + x/2 for large c, by Newton's method.  The
// function is concave and the start is below the root, where the method converges quadratically
// from the second step on.
double radius_less_two_from_log(double c) {
  constexpr int kSteps = 8;
  double half = c - 1 - std::log(c);
  for (int i = 0; i < kSteps; ++i) half -= (half + std::log(half) + 1 - c) / (1 + 1 / half);
  return 2 * half;
}

}  // namespace

double sign_of_u(Region region) { return region == Region::kI || region == Region::kII ? 1 : -1; }

double sign_of_v(Region region) { return region == Region::kII || region == Region::kIII ? 1 : -1; }

Region kruskal_region(double u, double v) {
  if (u * v > 0) return u > 0 ? Region::kII : Region::kIV;
  return u > 0 || v < 0 || (u == 0 && v == 0) ? Region::kI : Region::kIII;
}

KruskalPoint kruskal_point(Region region, double t, double r) {
  const bool far = r > kLargestPlainRadius;
  const double size = std::sqrt(std::abs(r - 2) / 2) * (far ? 1 : std::exp(r / 4));
  return {sign_of_u(region) * size, sign_of_v(region) * size, t, far ? r / 4 : 0};
}

double radius_less_two(double product_uv) {
  // x = r - 2 solves (x/2) exp(x/2) = -U V / e.
  if (!(product_uv <= 1)) return std::numeric_limits<double>::quiet_NaN();
  const double argument = -product_uv / std::numbers::e;
  if (argument <= -1 / std::numbers::e) return -2;
  return 2 * boost::math::lambert_w0(argument);
}

double kruskal_radius(const KruskalPoint& p) {
  const double product = p.u * p.v;
  if (p.growth == 0) return 2 + radius_less_two(product);
  return 2 + radius_less_two_from_log(std::log(-product) + 2 * p.growth);
}

double kruskal_time(const KruskalPoint& p) {
  return p.shift + 2 * (std::log(std::abs(p.u)) - std::log(std::abs(p.v)));
}

}  // namespace domefall
