// The images of places near a charge: place_image.cpp without its distances from the edge, which
// p of ChargedPaths does not need.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/bisect_by_threes.h"
#include "pipeline/light/charged_paths.h"
#include "pipeline/light/place_image.h"

namespace domefall {
namespace {

// The rays of a view by z = ln tan(alpha/2), where alpha counts from -R.  With t = tan(alpha/2)
//     p = (f/t - t)/(2 r),   E/L = (f/t + t)/(2 r).
class ChargedFan {
 public:
  explicit ChargedFan(const ChargedPlaceView& view)
      : paths_(view.hole, view.r),
        r_(view.r),
        lapse_squared_(view.hole.lapse_squared(view.r)),
        far_(view.far) {}

  double lapse_squared() const { return lapse_squared_; }

  // Returns r on n rays, each of its z, once they have swept psi.
  template <std::size_t n>
  std::array<double, n> r_on_each(const std::array<double, n>& z, double psi) const {
    std::array<double, n> p, e, psis, r;
    for (std::size_t k = 0; k < n; ++k) set(z[k], p[k], e[k]);
    psis.fill(psi);
    ChargedPaths::Places places;
    paths_.find(p.data(), e.data(), psis.data(), n, places);
    for (std::size_t k = 0; k < n; ++k) r[k] = 1 / places.w[k];
    return r;
  }

  // Returns the place on one ray, with its time.
  ChargedPaths::Places place(double z, double psi) const {
    double p = 0, e = 0;
    set(z, p, e);
    ChargedPaths::Places places;
    paths_.timed(&p, &e, &psi, 1, places);
    return places;
  }

  // Returns z of the ray that is at r after psi, or of the last ray on that side.  Between the
  // horizons E = 0 parts the rays of the two sides.
  double find(double r, double psi) const {
    constexpr double kAxis = 40;
    const double parting = lapse_squared_ < 0 ? std::log(-lapse_squared_) / 2 : -kAxis;
    // r grows away from there.
    const double low = parting, high = far_ ? -kAxis : kAxis;
    return bisect_by_threes(low, high, [&](const std::array<double, kHalvingPoints>& z) {
      const auto there = r_on_each(z, psi);
      std::array<bool, kHalvingPoints> beyond;
      std::ranges::transform(there, beyond.begin(), [r](double at) { return at > r; });
      return beyond;
    });
  }

 private:
  void set(double z, double& p, double& e) const {
    const double t = std::exp(z), over = 1 / (2 * r_);
    p = (lapse_squared_ / t - t) * over;
    e = (lapse_squared_ / t + t) * over;
  }

  ChargedPaths paths_;
  double r_, lapse_squared_;
  bool far_;
};

// Returns |dr/dalpha| at a fixed psi by a four-point difference of 1/r, over a step in which r
// changes by a hundredth and stays outside or within the horizon, so that no ray ends before it has
// swept psi.
double growth(const ChargedFan& fan, double z, double psi, double r, double sine, double horizon) {
  constexpr double kTrial = 1e-4, kSmall = 1e-3, kShare = 1e-2;
  // Next to the edge rays part by e^psi at most.
  double step = kTrial * std::exp(-psi), change = HUGE_VAL;
  for (int n = 0; n < 20; ++n, step /= 8) {
    const auto trial = fan.r_on_each(std::array{z + step, z - step}, psi);
    change = std::max(std::abs(r / trial[0] - 1), std::abs(r / trial[1] - 1));
    if (change < kShare) break;
  }
  const double share = std::min(kShare, std::abs(1 - horizon / r) / 4);
  const double h = std::min(kSmall, step * share / change);
  const auto there = fan.r_on_each(std::array{z + h, z - h, z + 2 * h, z - 2 * h}, psi);
  const double next = 1 / there[0] - 1 / there[1], second = 1 / there[2] - 1 / there[3];
  return r * r * std::abs(8 * next - second) / (12 * h * sine);  // dalpha = sin(alpha) dz
}

PlaceLight radial_light(const ChargedPlaceView& view, double r) {
  const bool outwards = r > view.r, to_home = outwards && !view.far;
  const double f = view.hole.lapse_squared(view.r), energy = to_home ? 1 : f;
  const double apart = (r - view.r) / std::abs(energy);
  // Light that falls from region I keeps v, all other u.
  const double twice = to_home ? 0 : 2 * (view.hole.tortoise(r) - view.hole.tortoise(view.r));
  PlaceLight light;
  light.sin_half = to_home ? 1 : 0;
  light.cos_half = to_home ? 0 : 1;
  light.energy = energy;
  light.null_time = twice;
  light.solid_angle_per_area = 1 / (apart * apart);
  light.angle_per_length = 1 / std::abs(apart);
  light.angle_per_psi = -r / apart;
  return light;
}

}  // namespace

std::optional<PlaceLight> image_of_place(const ChargedPlaceView& view, double r, double psi,
                                         double blur) {
  constexpr double kRadial = 1e-9;
  if (psi < kRadial) return radial_light(view, r);
  const ChargedFan fan(view);
  const double z = fan.find(r, psi), tangent = std::exp(z), f = fan.lapse_squared();
  const ChargedPaths::Places there = fan.place(z, psi);
  if (!(std::abs(there.w[0] * r - 1) < 1e-6)) return std::nullopt;  // no ray is there
  PlaceLight light;
  light.cos_half = 1 / std::hypot(1, tangent);
  light.sin_half = tangent * light.cos_half;
  light.energy = light.sin_half * light.sin_half + f * light.cos_half * light.cos_half;
  light.angular_momentum = 2 * view.r * light.sin_half * light.cos_half;
  light.slope = -r * r * there.slope[0];
  light.null_time = there.time[0];
  // Light that has hardly swept anything meets no caustic.
  const double swept = psi < std::numbers::pi ? std::sin(psi / 2) : 1;
  const double sine = std::hypot(std::sin(psi), blur * swept * swept);
  const double energy = std::abs(light.energy);
  const double rise =
      growth(fan, z, psi, r, 2 * light.sin_half * light.cos_half, view.hole.horizon());
  light.solid_angle_per_area = energy / (view.r * sine * rise);
  light.angle_per_length = energy * r / (light.angular_momentum * rise);
  light.angle_per_psi = -light.slope / rise;
  return light;
}

}  // namespace domefall
