#include "pipeline/render/scene/frame_plan.h"

#include <algorithm>

#include "pipeline/show/viewer.h"

namespace domefall {
namespace {

bool is_lit(const SkyBackground& background, const FrameSettings::Sky& now) {
  return !std::holds_alternative<BlackSky>(background) && now.background_gain > 0;
}

bool has_stars(const RegionSky& sky, const FrameSettings::Sky& now) {
  return sky.stars && now.star_gain > 0;
}

FramePlan::Sky plan_sky(const RegionSky& sky, const SkyBackground& background,
                        const FrameSettings::Sky& now) {
  return {is_lit(background, now), has_stars(sky, now),
          std::holds_alternative<RingsSky>(background), &background};
}

}  // namespace

bool FramePlan::has_background() const {
  return std::any_of(sky.begin(), sky.end(), [](const Sky& s) { return s.background; });
}

WantedSkies FramePlan::wanted() const {
  WantedSkies wanted;
  for (const SkyRegion which : kEverySky) wanted.sky[which] = sky[which].lit();
  wanted.pixel = pixel;
  wanted.emission_times = sky[SkyRegion::kIV].lit() && sky[SkyRegion::kIV].rings;
  return wanted;
}

FramePlan plan_frame(const Show& show, const FrameState& state) {
  const ObserverState& o = state.observer;
  const PerSky<bool> seen = seen_skies(o);
  FramePlan plan;
  plan.gravity = !is_flat(o) && show.effects.lensing;
  if (state.draft) {
    const auto celerity = viewer_of(o, show.effects).celerity;
    plan.pixel = largest_pixel_angle(state.projection) / (gamma_of(celerity) + celerity.length());
  }
  // An observer who falls from region I receives its light on the horizon itself too.  In a universe
  // further on another region I has no gas.
  const bool sees_gas =
      !is_flat(o) && o.universe == 0 &&
      (o.region == Region::kI || (o.region == Region::kII && seen[SkyRegion::kI]));
  plan.disc = show.disc && state.settings.disc_opacity > 0 && sees_gas;
  if (sees_gas && show.halo) plan.halo = &*show.halo;
  if (sees_gas && show.jet) plan.jet = &*show.jet;
  plan.gas = plan.halo || plan.jet || (plan.disc && show.disc->height > 0);
  const auto add = [&](SkyRegion which) {
    plan.sky[which] = plan_sky(show.sky[which], background_of(show, state.segment, which),
                               state.settings.sky[which]);
  };
  for (const SkyRegion sky : kExteriorSkies)
    if (seen[sky]) add(sky);
  // Rays that neither sky has come from the past singularity.
  if (plan.gravity && o.spacetime.is<Schwarzschild>()) add(SkyRegion::kIV);
  return plan;
}

}  // namespace domefall
