#include "pipeline/render/scene/star_sight.h"

#include <algorithm>

#include "pipeline/light/aberration.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/star_light.h"

namespace domefall {
namespace {

constexpr double kLeastSource = 1e-4;     // radians; it bounds the light of a star on the axis
constexpr int kWithoutAmplification = 2;  // orders

}  // namespace

StarSight::StarSight(const FrameState& state, const Effects& effects)
    : effects_(effects),
      observer_(state.observer),
      viewer_(viewer_of(state.observer, effects)),
      lens_(lens_of(state.observer, WantedSkies{}, effects)) {
  const PerSky<bool> seen = seen_skies(observer_);
  for (const SkyRegion sky : kExteriorSkies)
    if (seen[sky]) points_[sky] = lens_->points(sky, {});
}

bool StarSight::sees(SkyRegion sky) const { return points_[sky] != nullptr; }

int StarSight::orders() const {
  int orders = 0;
  for (const auto& points : points_)
    if (points) orders = std::max(orders, points->orders());
  return effects_.amplification == Amplification::kNone ? std::min(orders, kWithoutAmplification)
                                                        : orders;
}

StarSight::Image StarSight::image(SkyRegion sky, const SkyDirection& star, int order) const {
  const V3d source = apply_transposed(sky_axes(observer_, sky), star.v);
  const SkyImage at = out_of_lens(*lens_, points_[sky]->image(source, order, kLeastSource));
  const AberratedLight seen = to_observer(viewer_.celerity, at.direction.v);
  // The frequency changes from the star to the tetrad, from there to the observer whose directions
  // are drawn, and from this one to the observer who measures it.
  double g = at.frequency_ratio * seen.frequency_ratio;
  if (viewer_.measured) g *= to_observer(*viewer_.measured, seen.direction).frequency_ratio;
  return {{apply_transposed(observer_.tetrad_from_camera, seen.direction)},
          received_flux(effects_, 1, at.amplification, seen.frequency_ratio, g),
          g};
}

}  // namespace domefall
