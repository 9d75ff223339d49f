#include "pipeline/disc/page_thorne.h"

#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "pipeline/disc/disc.h"

namespace domefall {
namespace {

constexpr double kPullOnPlunge = 0.02, kStartOfPlunge = 0.01;
const double kRoot3 = std::sqrt(3.0), kRoot6 = std::sqrt(6.0);

// Returns artanh t - t for 0 <= t < 0.71.  Where the two terms would cancel, it is the sum of a
// series, whose rest is below 2e-17 of it.
double beyond_linear_artanh(double t) {
  if (t > 0.1) return std::atanh(t) - t;
  const double t2 = t * t;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = sum * t2 + 1.0 / k;
  return t * t2 * sum;
}

// With d = sqrt r - sqrt 6 and t = sqrt 3 d/(sqrt(6 r) - 3), B = d - sqrt 3 artanh t.  Its terms of
// first order in d cancel, so they are combined by hand.
double page_thorne_b(double r) {
  const double root = std::sqrt(r), d = (r - kLastStableOrbit) / (root + kRoot6);
  const double below = root * kRoot6 - 3;
  return kRoot6 * d * d / below - kRoot3 * beyond_linear_artanh(kRoot3 * d / below);
}

}  // namespace

PageThorneProfile::PageThorneProfile(bool plunging)
    : plunging_(plunging), pull_(plunging ? kRoot6 * kPullOnPlunge : 0) {
  // A function is flat next to its maximum, so its values tell the place to half of a double's bits
  // only.
  constexpr double kBeyond = 30;
  constexpr int kBits = 26;
  const auto found = boost::math::tools::brent_find_minima(
      [this](double r) { return -stable_flux(r); }, kLastStableOrbit, kBeyond, kBits);
  hottest_ = stable_flux(kLastStableOrbit) > -found.second ? kLastStableOrbit : found.first;
  greatest_ = stable_flux(hottest_);
}

double PageThorneProfile::stable_flux(double r) const {
  return (page_thorne_b(r) + pull_) / ((r - 3) * r * r * std::sqrt(r));
}

double PageThorneProfile::flux(double r) const {
  if (r >= kLastStableOrbit) return stable_flux(r) / greatest_;
  if (!plunging_ || r < kHorizonRadius) return 0;
  const double x = kLastStableOrbit / r, fall = (x - 1) * std::sqrt(x - 1);
  return stable_flux(kLastStableOrbit) / greatest_ * std::pow(x, 17.0 / 7) *
         std::pow(1 + fall / kStartOfPlunge, -1.0 / 7);
}

double PageThorneProfile::temperature(double r) const { return std::sqrt(std::sqrt(flux(r))); }

}  // namespace domefall
