#include "pipeline/light/place_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/bisect_by_threes.h"
#include "pipeline/light/emission_time.h"
#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/ray_times.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// Returns r on each of n rays of the view, of which `ray_of` tells the k-th, once it has swept psi.
// The loops of RayOrbits find as many places in the time of one as a register holds: up to eight.
template <std::size_t n, class RayOf>
std::array<double, n> r_on_each(const PlaceView& view, double psi, const RayOf& ray_of) {
  std::array<double, n> sin_half, cos_half, gap_first, gap_second, psis, r;
  for (std::size_t k = 0; k < n; ++k) {
    const NullRay ray = ray_of(k);
    sin_half[k] = ray.sin_half, cos_half[k] = ray.cos_half;
    gap_first[k] = ray.gap_first, gap_second[k] = ray.gap_second;
  }
  psis.fill(psi);
  RayOrbits orbits;
  orbits.set(view.at, view.outgoing,
             {sin_half.data(), cos_half.data(), gap_first.data(), gap_second.data()}, n);
  RayPlaces places;
  orbits.find(psis.data(), places);
  std::copy_n(places.r.begin(), n, r.begin());
  return r;
}

double r_after(const NullRay& ray, double psi, double* slope = nullptr) {
  RayOrbits orbits;
  orbits.set(ray.at, ray.outgoing, {&ray.sin_half, &ray.cos_half, &ray.gap_first, &ray.gap_second},
             1);
  RayPlaces places;
  orbits.find(&psi, places);
  if (slope) *slope = places.slope[0];
  return places.r[0];
}

// A RayFan gives rays of the view by z, with tan(alpha/2) = T exp(+-exp(z)).  T is that of the
// edge, and the ray lies on its outer side, where the sky is, or on its inner side.
class RayFan {
 public:
  explicit RayFan(const PlaceView& view)
      : view_(view),
        edge_(view.outgoing || view.far ? Critical::kSecond : Critical::kFirst),
        outer_(edge_ == Critical::kFirst ? 1 : -1),
        tangent_(tan_half_critical(view.at, edge_)) {}

  NullRay critical() const { return ray_of_ratio(view_.at, edge_, 0, view_.outgoing); }
  NullRay ray(double z, bool outside) const {
    constexpr double kNear = 0.5;
    const double y = (outside ? outer_ : -outer_) * std::exp(z);
    if (std::abs(y) < kNear) return ray_of_ratio(view_.at, edge_, std::expm1(y), view_.outgoing);
    return ray_of_tangent(view_.at, tangent_ * std::exp(y), view_.outgoing);
  }
  // Returns where z ends, next to the axis or, from region II, on the inner side, where E = 0.
  double range(bool outside) const {
    constexpr double kAxis = 6.4;
    if (outside || view_.at.above_horizon > 0) return kAxis;
    const double s = Schwarzschild::free_fall_speed(view_.at.r);
    const double without_energy = -Schwarzschild::below_light_speed(view_.at) / (1 + s);
    return std::log(std::abs(std::log(std::sqrt(without_energy) / tangent_)));
  }
  // Returns the sense of alpha in which r grows.
  double outer() const { return outer_; }
  // Returns z of the ray that is at r after psi, if one on that side is.
  std::optional<double> find(double r, double psi, bool outside) const;

 private:
  PlaceView view_;
  Critical edge_;
  double outer_, tangent_;
};

// Towards the edge r tends to that of the critical ray, away from it to its limit on that side.
std::optional<double> RayFan::find(double r, double psi, bool outside) const {
  const auto is_beyond = [&](double there) { return outside ? there > r : there < r; };
  const double low = -45, high = range(outside);
  const auto ends =
      r_on_each<2>(view_, psi, [&](std::size_t k) { return ray(k == 0 ? low : high, outside); });
  if (is_beyond(ends[0]) || !is_beyond(ends[1])) return std::nullopt;
  return bisect_by_threes(low, high, [&](const std::array<double, kHalvingPoints>& z) {
    const auto there =
        r_on_each<kHalvingPoints>(view_, psi, [&](std::size_t k) { return ray(z[k], outside); });
    std::array<bool, kHalvingPoints> beyond;
    std::ranges::transform(there, beyond.begin(), is_beyond);
    return beyond;
  });
}

double null_time_after(const NullRay& ray, double psi) {
  RayOrbits orbits;
  orbits.set(ray.at, ray.outgoing, {&ray.sin_half, &ray.cos_half, &ray.gap_first, &ray.gap_second},
             1);
  RayPlaces places;
  orbits.find(&psi, places);
  double time = 0;
  RayTimes(orbits).find(&psi, places, &time);
  return time;
}

// Returns |dr/dalpha| at a fixed psi by a four-point difference of 1/r, over a step in which r
// changes by a hundredth, so that no ray ends before it has swept psi.
double growth(const PlaceView& view, const NullRay& ray, double psi, double r, double outer) {
  constexpr double kTrial = 1e-6, kSmall = 1e-3, kShare = 1e-2;
  const double smooth = smooth_over(ray);
  const auto w = [&](double angle) { return 1 / r_after(turned(ray, outer * angle), psi); };
  const double trial = std::abs(w(-kTrial * smooth) * r - 1) / (kTrial * smooth);
  const double h = std::min(kSmall * smooth, kShare / trial);
  const std::array steps{h, -h, 2 * h, -2 * h};
  const auto there =
      r_on_each<4>(view, psi, [&](std::size_t k) { return turned(ray, outer * steps[k]); });
  const double next = 1 / there[0] - 1 / there[1], second = 1 / there[2] - 1 / there[3];
  return r * r * std::abs(8 * next - second) / (12 * h);
}

PlaceImage image_by(const NullRay& ray) {
  const RayInvariants k = invariants(ray);
  return {{ray.sin_half, ray.cos_half, k.energy, k.angular_momentum}, ray};
}

// Along the axis itself light diverges as in flat space, by its affine parameter r/|E|.  What is
// above the observer is seen the farther from the hole the nearer it is to the axis.
PlaceImage radial_image(const PlaceView& view, double r) {
  const bool outwards = r > view.at.r, to_home = outwards && !view.far;
  const double tangent = to_home != view.outgoing ? std::numeric_limits<double>::infinity() : 0;
  const NullRay ray = ray_of_tangent(view.at, tangent, view.outgoing);
  const double apart = (r - view.at.r) / one_plus_z(ray);
  // Light that falls from region I keeps v, all other u.
  const double twice = to_home != view.outgoing
                           ? 0
                           : 2 * (Schwarzschild::tortoise(r) - Schwarzschild::tortoise(view.at));
  PlaceImage image = image_by(ray);
  image.null_time = view.outgoing ? -twice : twice;
  image.solid_angle_per_area = 1 / (apart * apart);
  image.angle_per_length = 1 / std::abs(apart);
  image.angle_per_psi = -r / apart;
  return image;
}

}  // namespace

std::optional<PlaceImage> image_of_place(const PlaceView& view, double r, double psi, double blur) {
  constexpr double kRadial = 1e-9;
  if (view.outgoing && view.at.above_horizon <= 0) return std::nullopt;
  if (psi < kRadial) return radial_image(view, r);
  const RayFan fan(view);
  const bool outside = r_after(fan.critical(), psi) < r;
  const std::optional<double> z = fan.find(r, psi, outside);
  if (!z) return std::nullopt;
  PlaceImage image = image_by(fan.ray(*z, outside));
  const double there = r_after(image.ray, psi, &image.slope);
  if (!(std::abs(there / r - 1) < 1e-6)) return std::nullopt;  // no ray is there: it jumps
  image.null_time = null_time_after(image.ray, psi);
  // Light that has hardly swept anything meets no caustic.
  const double swept = psi < std::numbers::pi ? std::sin(psi / 2) : 1;
  const double sine = std::hypot(std::sin(psi), blur * swept * swept);
  const double energy = one_plus_z(image.ray), rise = growth(view, image.ray, psi, r, fan.outer());
  image.solid_angle_per_area = energy / (view.at.r * sine * rise);
  // The rays of two places that are dr apart at one psi are |dr| L/(r E) apart at right angles.
  image.angle_per_length = energy * r / (image.angular_momentum * rise);
  image.angle_per_psi = -image.slope / rise;
  return image;
}

}  // namespace domefall
