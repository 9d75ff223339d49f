#include "pipeline/render/frame_plan.h"

#include <algorithm>

namespace domefall {
namespace {

bool shows_anything(const RegionSky& sky, const Picture::Sky& now) {
  return !std::holds_alternative<BlackSky>(sky.background) && now.background_gain > 0;
}

bool has_stars(const RegionSky& sky, const Picture::Sky& now) {
  return sky.stars && now.star_gain > 0;
}

FramePlan::Sky plan_sky(const RegionSky& sky, const Picture::Sky& now) {
  return {shows_anything(sky, now), has_stars(sky, now),
          std::holds_alternative<RingsSky>(sky.background)};
}

}  // namespace

bool FramePlan::background() const {
  return std::any_of(sky.begin(), sky.end(), [](const Sky& s) { return s.background; });
}

FramePlan plan_frame(const Show& show, const FrameState& state) {
  const ObserverState& o = state.observer;
  const bool inside = o.region == Region::kII && o.r < 2;
  FramePlan plan;
  plan.gravity = !is_flat(o) && show.effects.lensing;
  const auto set = [&](SeenSky which, const RegionSky& sky) {
    plan.sky[static_cast<std::size_t>(which)] = plan_sky(sky, sky_of(state.picture, which));
  };
  const bool mirrored = is_mirrored(o.tetrad);
  const bool home = o.region != Region::kIV;
  if (mirrored ? inside : home) set(SeenSky::kOne, show.sky_one);
  if (mirrored ? home : inside) set(SeenSky::kThree, show.sky_three);
  if (plan.gravity) set(SeenSky::kFour, show.sky_four);
  return plan;
}

}  // namespace domefall
