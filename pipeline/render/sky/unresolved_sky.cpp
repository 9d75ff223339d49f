#include "pipeline/render/sky/unresolved_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/render/scene/photometry.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A pixel that sees more of a sky than this (radians, about the larger side of its footprint) is
// crowded; the spot is what lies within so many pixels of it.
constexpr double kCrowded = 0.5, kCapPixels = 1.5;
// From a pixel's middle to its corner, a little more.
constexpr double kHalfDiagonal = 0.75;
// Samples from the edge of a sky to its far end, and around the axis.
constexpr int kAlong = 192, kAround = 384;

class UnresolvedSkyFinder {
 public:
  UnresolvedSkyFinder(const Show& show, const FrameState& state, const HoleOptics& optics)
      : show_(show),
        observer_(state.observer),
        settings_(state.settings),
        projection_(state.projection),
        tracer_(state, optics, show.effects),
        vantage_(vantage_of(state.observer, show.effects)),
        to_observer_(-vantage_.celerity),
        to_measured_(-vantage_.measured.value_or(V3d(0, 0, 0))),
        pixel_(central_pixel_angle(state.projection)) {}

  // toward: where the sky's light might be crowded, in the tetrad of the observer.
  void integrate_lensed(const Sky& sky, SkyRegion name, const SkyTable& table, const V3d& toward,
                        UnresolvedSkies& found) const {
    const auto spot = unresolved_cap(name, toward, found);
    if (!spot) return;
    Light light;
    gather(sky, table, *spot, light);
    add(*spot, light, found);
  }

  // The same where light goes straight: ahead.
  void integrate_straight(const Sky& sky, SkyRegion name, UnresolvedSkies& found) const {
    const auto spot = unresolved_cap(name, vantage_.celerity.normalized(), found);
    if (!spot) return;
    Light light;
    gather_straight(sky, *spot, light);
    add(*spot, light, found);
  }

 private:
  // Of a spot, so far.
  struct Light {
    double rgb[3] = {0, 0, 0};
    V3d middle{0, 0, 0};

    void add(const WorkingRgb& c, double solid_angle, const V3d& n) {
      rgb[0] += c.r * solid_angle, rgb[1] += c.g * solid_angle, rgb[2] += c.b * solid_angle;
      middle += n * (luminance(c) * solid_angle);
    }
  };

  std::optional<DarkenedCap> unresolved_cap(SkyRegion name, const V3d& toward,
                                            const UnresolvedSkies& found) const {
    const CameraDirection centre{apply_transposed(observer_.tetrad_from_camera, toward)};
    const double reach2 = kCapPixels * kCapPixels * pixel_ * pixel_;
    for (const DarkenedCap& other : found.darkened)
      if (other.sky == name && (other.centre.v - centre.v).length2() < 4 * reach2)
        return std::nullopt;
    const ViewRay look = tracer_.trace(centre);
    if (!look.known || look.sky != name ||
        !(std::max(look.radial_scale, look.tangential_scale) * pixel_ > kCrowded))
      return std::nullopt;
    return DarkenedCap{name, centre, reach2};
  }

  void add(const DarkenedCap& spot, const Light& light, UnresolvedSkies& found) const {
    if (!(light.middle.length() > 0)) return;
    const auto at = pixel_of(projection_, {light.middle.normalized()});
    if (!at) return;
    CapBlob blob{};
    for (int c = 0; c < 3; ++c) blob.rgb[c] = static_cast<float>(light.rgb[c]);
    blob.x = static_cast<float>(at->i - 1), blob.y = static_cast<float>(at->j - 1);
    blob.sigma = static_cast<float>(kLeastSigmaPixels * pixel_);
    if (!place_cap(projection_, blob)) return;
    found.darkened.push_back(spot);
    found.blobs.push_back(blob);
  }

  // Whether light from there belongs to a pixel that is looked at within the spot: what is gathered is what
  // the looks leave out.
  bool is_darkened(const DarkenedCap& spot, const V3d& n) const {
    const auto at = pixel_of(projection_, {n});
    const V3d look = at ? direction_at(projection_, {std::round(at->i), std::round(at->j)}).v : n;
    return (look - spot.centre.v).length2() <= spot.chord2;
  }

  double scale_of(SkyRegion sky) const {
    return exposure_scale(settings_) * settings_.sky[sky].background_gain;
  }

  // The light of all samples of the sky that arrive within the spot.
  void gather(const Sky& sky, const SkyTable& table, const DarkenedCap& spot, Light& light) const {
    const double reach = 4 * std::atan(table.x_max() / 2), d_alpha = reach / kAlong;
    const double d_psi = 2 * pi / kAround;
    const double scale = scale_of(spot.sky);
    const bool amplified = show_.effects.amplification == Amplification::kEverything;
    for (int i = 0; i < kAlong; ++i) {
      const double x = 2 * std::tan((i + 0.5) * d_alpha / 4);
      const NullRay ray = table.ray_at_distance(x);
      const double sine = 2 * ray.sin_half * ray.cos_half;
      const double cosine = (ray.cos_half - ray.sin_half) * (ray.cos_half + ray.sin_half);
      const double phi = table.azimuth(x), g = 1 / one_plus_z(ray);
      const double slope = table.slope(x), ray_angle = 2 * std::atan2(ray.sin_half, ray.cos_half);
      const double footprint = std::max(slope * d_alpha, std::abs(std::sin(phi)) * d_psi);
      for (int j = 0; j < kAround; ++j) {
        const V3d e(0, std::cos((j + 0.5) * d_psi), std::sin((j + 0.5) * d_psi));
        const AberratedLight seen =
            to_observer_.to_rest(V3d(ray.outgoing ? cosine : -cosine, 0, 0) + e * sine);
        const V3d n = apply_transposed(observer_.tetrad_from_camera, seen.direction);
        if (!is_darkened(spot, n)) continue;
        const double d = seen.frequency_ratio;
        const double measured =
            vantage_.measured ? to_measured_.to_rest(seen.direction).frequency_ratio : 1;
        const V3d from =
            apply(observer_.sky_from_tetrad, V3d(std::cos(phi), 0, 0) + e * std::sin(phi));
        const WorkingRgb c = background_light(sky, show_, from, footprint, g * d * measured, scale);
        const double f = amplified ? amplification({ray_angle, phi, slope, d}, pixel_) : 1;
        light.add(c, f * sine * d_alpha * d_psi / (d * d), n);
      }
    }
  }

  // Rings about the direction of motion, out to those that arrive at the spot's last pixels: by [Riazuelo]
  // eq. eq_inv_aberr, tan(alpha/2) = (gamma + |celerity|) tan(alpha'/2).
  void gather_straight(const Sky& sky, const DarkenedCap& spot, Light& light) const {
    const double speed = vantage_.celerity.length(), widening = std::hypot(1, speed) + speed;
    const double edge = std::min((kCapPixels + kHalfDiagonal) * pixel_, pi);
    const double d_alpha = 2 * std::atan(widening * std::tan(edge / 2)) / kAlong;
    const double d_psi = 2 * pi / kAround;
    const double scale = scale_of(spot.sky);
    const bool amplified = show_.effects.amplification == Amplification::kEverything;
    const V3d ahead = vantage_.celerity / speed;
    const V3d aside =
        ahead.cross(std::abs(ahead.x) < 0.5 ? V3d(1, 0, 0) : V3d(0, 1, 0)).normalized();
    const V3d third = ahead.cross(aside);
    for (int i = 0; i < kAlong; ++i) {
      const double alpha = (i + 0.5) * d_alpha, sine = std::sin(alpha), cosine = std::cos(alpha);
      // cos(alpha - d/2) - cos(alpha + d/2), exactly.
      const double area = 2 * sine * std::sin(d_alpha / 2) * d_psi;
      const double footprint = std::max(d_alpha, sine * d_psi);
      for (int j = 0; j < kAround; ++j) {
        const double psi = (j + 0.5) * d_psi;
        const AberratedLight seen = to_observer_.to_rest(
            ahead * cosine + (aside * std::cos(psi) + third * std::sin(psi)) * sine);
        const V3d n = apply_transposed(observer_.tetrad_from_camera, seen.direction);
        if (!is_darkened(spot, n)) continue;
        const ViewRay look = tracer_.trace({n});
        const double d = seen.frequency_ratio;
        const double f = amplified ? amplification(look.bundle, pixel_) : 1;
        light.add(background_light(sky, show_, look.sky_direction, footprint, look.frequency_ratio,
                                   scale),
                  f * area / (d * d), n);
      }
    }
  }

  const Show& show_;
  const ObserverState& observer_;
  const FrameSettings& settings_;
  Projection projection_;
  ViewTracer tracer_;
  Vantage vantage_;
  Aberration to_observer_, to_measured_;
  double pixel_;
};

}  // namespace

UnresolvedSkies find_unresolved_skies(const Show& show, const FrameState& state,
                                      const HoleOptics& optics, const PixelShader::Skies& skies) {
  UnresolvedSkies found;
  const UnresolvedSkyFinder finder(show, state, optics);
  const V3d celerity = vantage_of(state.observer, show.effects).celerity;
  if (is_flat(state.observer) || !show.effects.lensing) {
    const Sky* sky = skies[SkyRegion::kI];
    if (sky != nullptr && celerity.length() > 1)
      finder.integrate_straight(*sky, SkyRegion::kI, found);
    return found;
  }
  // The far ends of both skies lie on the axis: home outward, far inward.
  const auto look_for = [&](SkyRegion name, double outward) {
    const SkyTable* table = optics.table_of(name);
    const Sky* sky = skies[name];
    if (sky == nullptr || table == nullptr) return;
    finder.integrate_lensed(*sky, name, *table, to_observer(celerity, V3d(outward, 0, 0)).direction,
                            found);
    if (celerity.length() > 1)
      finder.integrate_lensed(*sky, name, *table, celerity.normalized(), found);
  };
  look_for(home_sky(optics.tetrad), 1);
  look_for(far_sky(optics.tetrad), -1);
  return found;
}

}  // namespace domefall
