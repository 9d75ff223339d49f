#include "pipeline/render/sky/unresolved_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/light/aberration.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A pixel is crowded if the larger side of its footprint on the sky exceeds kCrowded (radians).
// Then a cap of kCapPixels around it is integrated instead.
constexpr double kCrowded = 0.5, kCapPixels = 1.5;
// This is more than the 0.71 pixels from a pixel's middle to its corner.
constexpr double kHalfDiagonal = 0.75;
// These are the numbers of samples from the edge of a sky to its far end, and around that.
constexpr int kAlong = 192, kAround = 384;

// A CapLight is the light that has been gathered in a cap.
struct CapLight {
  double rgb[3] = {0, 0, 0};
  V3d middle{0, 0, 0};  // the sum of directions, weighted by luminance

  void add(const WorkingRgb& c, double solid_angle, const V3d& n) {
    rgb[0] += c.r * solid_angle;
    rgb[1] += c.g * solid_angle;
    rgb[2] += c.b * solid_angle;
    middle += n * (luminance(c) * solid_angle);
  }
};

class UnresolvedSkyFinder {
 public:
  explicit UnresolvedSkyFinder(const FrameScene& scene)
      : scene_(scene),
        observer_(scene.state.observer),
        viewer_(scene.tracer.viewer()),
        to_observer_(-viewer_.celerity),
        to_measured_(-viewer_.measured.value_or(Celerity<RestFrame>())),
        pixel_(largest_pixel_angle(scene.projection())) {}

  // Looks for a sky that lensing crowds around `toward`, a direction in the observer's tetrad.
  void integrate_lensed(SkyRegion sky, const V3d& toward, UnresolvedSkies& found) const {
    const auto cap = crowded_cap(sky, toward, found);
    if (!cap) return;
    CapLight light;
    gather_lensed(sky, *cap, light);
    add(*cap, light, found);
  }

  // Looks for a sky that aberration alone crowds ahead.
  void integrate_straight(SkyRegion sky, UnresolvedSkies& found) const {
    const auto cap = crowded_cap(sky, viewer_.celerity.normalized(), found);
    if (!cap) return;
    CapLight light;
    gather_straight(*scene_.background[sky], *cap, light);
    add(*cap, light, found);
  }

 private:
  // Returns the cap around a direction if the pixel there is crowded and no cap of this sky
  // overlaps it.
  std::optional<DarkenedCap> crowded_cap(SkyRegion sky, const V3d& toward,
                                         const UnresolvedSkies& found) const {
    const CameraDirection centre{apply_transposed(observer_.tetrad_from_camera, toward)};
    const double reach2 = kCapPixels * kCapPixels * pixel_ * pixel_;
    for (const DarkenedCap& other : found.darkened)
      if (other.sky == sky && (other.centre.v - centre.v).length2() < 4 * reach2)
        return std::nullopt;
    const ViewRay ray = scene_.tracer.trace(centre);
    if (!ray.known || ray.sky != sky || !(ray.longer() * pixel_ > kCrowded)) return std::nullopt;
    return DarkenedCap{sky, centre, reach2};
  }

  // Draws the gathered light as a star of the least width, at the mean direction.
  void add(const DarkenedCap& cap, const CapLight& light, UnresolvedSkies& found) const {
    if (!(light.middle.length() > 0)) return;
    const auto at = pixel_of(scene_.projection(), {light.middle.normalized()});
    if (!at) return;
    CapBlob blob{};
    for (int c = 0; c < 3; ++c) blob.rgb[c] = static_cast<float>(light.rgb[c]);
    blob.x = static_cast<float>(at->i - 1);
    blob.y = static_cast<float>(at->j - 1);
    blob.sigma = static_cast<float>(kLeastSigmaPixels * pixel_);
    if (!place_cap(scene_.projection(), blob)) return;
    found.darkened.push_back(cap);
    found.blobs.push_back(blob);
  }

  // Says whether light from direction n belongs to a pixel whose ray lies within the cap.  The
  // gathered light is exactly what those pixels leave out.
  bool is_darkened(const DarkenedCap& cap, const V3d& n) const {
    const auto at = pixel_of(scene_.projection(), {n});
    const V3d ray =
        at ? direction_at(scene_.projection(), {std::round(at->i), std::round(at->j)}).v : n;
    return (ray - cap.centre.v).length2() <= cap.chord2;
  }

  // Adds the light of all samples of the sky that arrive within the cap.  The observer sees each
  // steradian of the tetrad's view as 1/d^2 steradians, where d is the frequency ratio.
  void gather_lensed(SkyRegion sky, const DarkenedCap& cap, CapLight& light) const {
    const bool amplified = scene_.amplifies_backgrounds();
    for (const SkySample& sample : scene_.tracer.lens()->divided(sky, kAlong, kAround)) {
      const AberratedLight seen = to_observer_.to_rest(sample.direction);
      const V3d n = apply_transposed(observer_.tetrad_from_camera, seen.direction);
      if (!is_darkened(cap, n)) continue;
      const double d = seen.frequency_ratio;
      const double measured =
          viewer_.measured ? to_measured_.to_rest(seen.direction).frequency_ratio : 1;
      const WorkingRgb c = scene_.background[sky]->at(sample.sky_direction, sample.footprint,
                                                      sample.frequency_ratio * d * measured);
      RayBundle bundle = sample.bundle;
      bundle.doppler = d;
      const double f = amplified ? amplification(bundle, pixel_) : 1;
      light.add(c, f * sample.solid_angle / (d * d), n);
    }
  }

  // Adds the light of rings around the direction of motion.  The last ring, at the angle alpha,
  // arrives at the angle alpha' in the cap's last pixels, where
  //     tan(alpha/2) = (gamma + |celerity|) tan(alpha'/2)
  // by [Riazuelo] eq. eq_inv_aberr, written in half angles.  The observer sees each steradian as
  // 1/d^2 steradians, where d is the frequency ratio.
  void gather_straight(const SkyLight& sky, const DarkenedCap& cap, CapLight& light) const {
    const double speed = viewer_.celerity.length(), widening = std::hypot(1, speed) + speed;
    const double edge = std::min((kCapPixels + kHalfDiagonal) * pixel_, pi);
    const double d_alpha = 2 * std::atan(widening * std::tan(edge / 2)) / kAlong;
    const double d_psi = 2 * pi / kAround;
    const bool amplified = scene_.amplifies_backgrounds();
    const V3d ahead = viewer_.celerity / speed;
    const V3d aside =
        ahead.cross(std::abs(ahead.x) < 0.5 ? V3d(1, 0, 0) : V3d(0, 1, 0)).normalized();
    const V3d third = ahead.cross(aside);
    for (int i = 0; i < kAlong; ++i) {
      const double alpha = (i + 0.5) * d_alpha, sine = std::sin(alpha), cosine = std::cos(alpha);
      // A ring from alpha - d/2 to alpha + d/2 has cos(alpha - d/2) - cos(alpha + d/2) steradians
      // per radian of psi, which is 2 sin(alpha) sin(d/2).
      const double area = 2 * sine * std::sin(d_alpha / 2) * d_psi;
      const double footprint = std::max(d_alpha, sine * d_psi);
      for (int j = 0; j < kAround; ++j) {
        const double psi = (j + 0.5) * d_psi;
        const AberratedLight seen = to_observer_.to_rest(
            ahead * cosine + (aside * std::cos(psi) + third * std::sin(psi)) * sine);
        const V3d n = apply_transposed(observer_.tetrad_from_camera, seen.direction);
        if (!is_darkened(cap, n)) continue;
        const ViewRay ray = scene_.tracer.trace({n});
        const double d = seen.frequency_ratio;
        const double f = amplified ? amplification(ray.bundle, pixel_) : 1;
        light.add(sky.at(ray.sky_direction, footprint, ray.frequency_ratio), f * area / (d * d), n);
      }
    }
  }

  const FrameScene& scene_;
  const ObserverState& observer_;
  const Viewer& viewer_;
  Aberration to_observer_, to_measured_;
  double pixel_;  // radians, in the middle of the image
};

}  // namespace

UnresolvedSkies find_unresolved_skies(const FrameScene& scene) {
  UnresolvedSkies found;
  const UnresolvedSkyFinder finder(scene);
  const V3d& celerity = scene.tracer.viewer().celerity;
  const bool fast = celerity.length() > 1;
  const SkyRegion own = own_sky(scene.state.observer);
  if (!scene.plan.gravity) {
    if (scene.background[own] && fast) finder.integrate_straight(own, found);
    return found;
  }
  const Lens& lens = *scene.tracer.lens();
  const auto integrate = [&](SkyRegion sky) {
    const auto far_ends = lens.far_ends(sky);
    if (!scene.background[sky] || far_ends.empty()) return;
    for (const V3d& end : far_ends)
      finder.integrate_lensed(sky, to_observer(celerity, end).direction, found);
    if (fast) finder.integrate_lensed(sky, celerity.normalized(), found);
  };
  integrate(own);
  for (const SkyRegion sky : kExteriorSkies)
    if (sky != own) integrate(sky);
  return found;
}

}  // namespace domefall
