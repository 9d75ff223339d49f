#include "pipeline/render/sky_spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/render/photometry.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A pixel that sees more of a sky than this (radians, about the larger side of its footprint) is
// crowded; the spot is what lies within so many pixels of it.
constexpr double kCrowded = 0.5, kSpotPixels = 1.5;
// Samples from the edge of a sky to its far end, and around the axis.
constexpr int kAlong = 192, kAround = 384;

class SpotFinder {
 public:
  SpotFinder(const Show& show, const FrameState& state, const HoleOptics& optics)
      : show_(show),
        observer_(state.observer),
        picture_(state.picture),
        projection_(state.projection),
        tracer_(state, optics, show.effects),
        vantage_(vantage_of(state.observer, show.effects)),
        to_observer_(-vantage_.celerity),
        to_measured_(-vantage_.measured.value_or(V3d(0, 0, 0))),
        pixel_(central_pixel_angle(state.projection)) {}

  // toward: where the sky's light might be crowded, in the tetrad of the observer.
  void try_spot(const Sky& sky, SeenSky name, const SkyTable& table, const V3d& toward,
                SkySpots& found) const {
    const CameraDirection centre{apply_transposed(observer_.tetrad_from_camera, toward)};
    const double reach2 = kSpotPixels * kSpotPixels * pixel_ * pixel_;
    for (const DarkenedSpot& other : found.darkened)
      if (other.sky == name && (other.centre.v - centre.v).length2() < 4 * reach2) return;
    const Look look = tracer_.look(centre);
    if (!look.known || look.sky != name) return;
    if (!(std::max(look.radial_scale, look.tangential_scale) * pixel_ > kCrowded)) return;
    const DarkenedSpot spot{name, centre, reach2};
    StarBlob blob{};
    if (!integrate(sky, table, spot, blob)) return;
    found.darkened.push_back(spot);
    found.blobs.push_back(blob);
  }

 private:
  // The light of all samples of the sky that arrive within the spot.
  bool integrate(const Sky& sky, const SkyTable& table, const DarkenedSpot& spot,
                 StarBlob& blob) const {
    const double reach = 4 * std::atan(table.x_max() / 2), d_alpha = reach / kAlong;
    const double d_psi = 2 * pi / kAround;
    const double scale = exposure_scale(picture_) * sky_of(picture_, spot.sky).background_gain;
    const bool amplified = show_.effects.amplification == Amplification::kEverything;
    double rgb[3] = {0, 0, 0};
    V3d middle(0, 0, 0);
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
        if ((n - spot.centre.v).length2() > spot.chord2) continue;
        const double d = seen.frequency_ratio;
        const double measured =
            vantage_.measured ? to_measured_.to_rest(seen.direction).frequency_ratio : 1;
        const V3d from =
            apply(observer_.sky_from_tetrad, V3d(std::cos(phi), 0, 0) + e * std::sin(phi));
        const WorkingRgb c = background_light(sky, show_, from, footprint, g * d * measured, scale);
        const double f = amplified ? amplification({ray_angle, phi, slope, d}, pixel_) : 1;
        const double solid_angle = f * sine * d_alpha * d_psi / (d * d);
        rgb[0] += c.r * solid_angle, rgb[1] += c.g * solid_angle, rgb[2] += c.b * solid_angle;
        middle += n * (luminance(c) * solid_angle);
      }
    }
    if (!(middle.length() > 0)) return false;
    for (int c = 0; c < 3; ++c) blob.rgb[c] = static_cast<float>(rgb[c]);
    const auto at = pixel_of(projection_, {middle.normalized()});
    if (!at) return false;
    blob.x = static_cast<float>(at->i - 1), blob.y = static_cast<float>(at->j - 1);
    blob.sigma = static_cast<float>(kLeastSigmaPixels * pixel_);
    return place_blob(projection_, blob);
  }

  const Show& show_;
  const ObserverState& observer_;
  const Picture& picture_;
  Projection projection_;
  ViewTracer tracer_;
  Vantage vantage_;
  Aberration to_observer_, to_measured_;
  double pixel_;
};

}  // namespace

SkySpots find_sky_spots(const Show& show, const FrameState& state, const HoleOptics& optics,
                        const PixelLight::Skies& skies) {
  SkySpots found;
  if (is_flat(state.observer)) return found;
  const SpotFinder finder(show, state, optics);
  const V3d celerity = vantage_of(state.observer, show.effects).celerity;
  const bool mirrored = is_mirrored(optics.tetrad);
  // The far ends of both skies lie on the axis: home outward, far inward.
  const auto look_for = [&](SeenSky name, const std::optional<SkyTable>& table, double outward) {
    const Sky* sky = skies[static_cast<std::size_t>(name)];
    if (sky == nullptr || !table) return;
    finder.try_spot(*sky, name, *table, to_observer(celerity, V3d(outward, 0, 0)).direction, found);
    if (celerity.length() > 1) finder.try_spot(*sky, name, *table, celerity.normalized(), found);
  };
  look_for(mirrored ? SeenSky::kThree : SeenSky::kOne, optics.home_sky, 1);
  look_for(mirrored ? SeenSky::kOne : SeenSky::kThree, optics.far_sky, -1);
  return found;
}

}  // namespace domefall
