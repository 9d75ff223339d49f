#include "pipeline/render/rays/view_tracer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/render/rays/singularity_light.h"

namespace domefall {

ViewTracer::ViewTracer(const FrameState& state, const HoleOptics& optics, const Effects& effects)
    : tetrad_from_camera_(state.observer.tetrad_from_camera),
      sky_from_tetrad_(state.observer.sky_from_tetrad),
      vantage_(vantage_of(state.observer, effects)),
      optics_(optics),
      flat_(is_flat(state.observer)),
      outgoing_(is_outgoing(state.observer.tetrad)),
      own_sky_(own_sky(state.observer.tetrad)),
      s_(std::sqrt(2 / state.observer.r)),
      one_minus_s_(flat_ ? 1 : (state.observer.r - 2) / (state.observer.r * (1 + s_))) {
  // The boost to an observer with celerity c is that to rest with -c (aberration.h).
  if (vantage_.measured) to_measured_.emplace(-*vantage_.measured);
  if (effects.lensing || flat_) return;
  to_rest_.emplace(-vantage_.rest);
  gravitational_ratio_ = gravitational_ratio(state.observer.r);
}

ViewRay ViewTracer::lensed_ray(const CameraDirection& n) const {
  const AberratedLight in = Aberration(vantage_.celerity).to_rest(apply(tetrad_from_camera_, n.v));
  ViewRay ray;
  if (flat_) {
    ray.sky = SkyRegion::kI;
    ray.known = true;
    ray.sky_direction = apply(sky_from_tetrad_, in.direction);
    ray.frequency_ratio = ray.radial_scale = ray.tangential_scale = 1 / in.frequency_ratio;
    ray.bundle.doppler = ray.frequency_ratio;
    return ray;
  }
  const V3d& d = in.direction;
  const double sin_alpha = std::hypot(d.y, d.z);
  const HalfAngle half = half_angle(outgoing_ ? d.x : -d.x, sin_alpha);
  const SkyTable* table = nullptr;
  double x = -1;
  // A ray on a sky's side of its edge comes from that sky.  A ray that no sky has comes from the
  // past singularity.  An edge counts unless both of its sides are dark.
  for (const SkyRegion sky : optics_.skies()) {
    const SkyEdge* edge = optics_.edge_of(sky);
    if (edge == nullptr) continue;
    const SkyTable* its = optics_.table_of(sky);
    const double away = edge->distance(half.sine, half.cosine);
    if (its || optics_.white_hole)
      ray.to_edge = std::min(ray.to_edge, 2 * std::abs(away) * in.frequency_ratio);
    if (!(away > 0) || ray.sky != SkyRegion::kIV) continue;
    ray.sky = sky;
    x = away;
    table = its;
  }
  double phi = 0, slope = 0;
  if (ray.sky == SkyRegion::kIV) {
    if (!optics_.white_hole) return ray;
    const WhiteHoleTable::Place place = optics_.white_hole->place_of(half.sine, half.cosine);
    phi = optics_.white_hole->azimuth(place);
    slope = bounded_slope(*optics_.white_hole, place);
    if (optics_.emission_times) {
      const auto value = emission_of(optics_, half, phi, slope);
      ray.emission_time = value.time;
      ray.time_scale = value.slope / in.frequency_ratio;
    }
  } else {
    if (!table) return ray;
    phi = table->azimuth(x);
    slope = table->slope(x);
    ray.bundle = {2 * std::atan2(half.sine, half.cosine), phi, slope, 1 / in.frequency_ratio};
    // |E| = |1 - s cos(alpha)| is written by half of alpha, so that it does not cancel near r = 2.
    const double energy =
        std::abs((1 + s_) * half.sine * half.sine + one_minus_s_ * half.cosine * half.cosine);
    ray.frequency_ratio = 1 / (energy * in.frequency_ratio);
  }
  ray.known = true;
  // The light started at cos(phi) R + sin(phi) e, with e the part of d across R made a unit vector.
  const double across = sin_alpha > 0 ? std::sin(phi) / sin_alpha : 0;
  ray.sky_direction = apply(sky_from_tetrad_, V3d(std::cos(phi), d.y * across, d.z * across));
  ray.radial_scale = slope / in.frequency_ratio;
  ray.tangential_scale = std::abs(across) / in.frequency_ratio;
  return ray;
}

}  // namespace domefall
