#include "pipeline/render/scene/frame_scene.h"

#include <utility>

#include "pipeline/render/scene/exposure.h"
#include "trajectories/directions.h"

namespace domefall {
namespace {

PerSky<const SceneStars*> stars_of_skies(const FramePlan& plan, const PerSky<const Sky*>& skies) {
  PerSky<const SceneStars*> stars{};
  for (const SkyRegion sky : kEverySky)
    if (plan[sky].stars) stars[sky] = skies[sky]->stars.get();
  return stars;
}

double brightness_of(const FramePlan::Sky& sky) {
  const auto* panorama = sky.shown ? std::get_if<PanoramaSky>(sky.shown) : nullptr;
  return panorama ? panorama->brightness : 1;
}

// The exposure, the gain at this instant and the brightness of a panorama become one scale.
PerSky<std::optional<SkyLight>> backgrounds_of(const Show& show, const FrameState& state,
                                               const FramePlan& plan,
                                               const PerSky<const Sky*>& skies, double exposure) {
  PerSky<std::optional<SkyLight>> light;
  for (const SkyRegion sky : kEverySky)
    if (plan[sky].background)
      light[sky].emplace(
          *skies[sky], show.effects, show.panorama_shift,
          exposure * state.settings.sky[sky].background_gain * brightness_of(plan[sky]));
  return light;
}

M33d turned(const M33d& whole, const CubemapFace& face) {
  return from_columns(apply(whole, face.axes[0]), apply(whole, face.axes[1]),
                      apply(whole, face.axes[2]));
}
FrameState looking_through(const FrameState& state, const CubemapFace& face) {
  FrameState looking = state;
  looking.projection = face.projection;
  looking.observer.tetrad_from_camera = turned(state.observer.tetrad_from_camera, face);
  return looking;
}
BodyTimes looking_through(const BodyTimes& times, const CubemapFace& face) {
  if (!times.at) return times;
  BodyTimes looking = times;
  looking.at = [at = times.at, face](double frames, CameraMotion camera) {
    ObserverState observer = at(frames, camera);
    observer.tetrad_from_camera = turned(observer.tetrad_from_camera, face);
    return observer;
  };
  return looking;
}

}  // namespace

BodyTimes body_times(const Show& show, const FrameState& state, double open) {
  if (show.bodies.empty()) return {};
  const SegmentSpan span = segment_span(show, state);
  return {open, span.begin, span.end, [&show, state](double frames, CameraMotion camera) {
            return observer_after(show, state, frames, camera);
          }};
}

FrameScene::FrameScene(const Show& show, const FrameState& frame, const FramePlan& frame_plan,
                       std::shared_ptr<const Lens> lens, const PerSky<const Sky*>& skies,
                       SkyMotion sky_motion, const DiscLight* disc_light, BodyTimes times)
    : state(frame),
      effects(show.effects),
      plan(frame_plan),
      tracer(state, std::move(lens), show.effects),
      exposure(exposure_scale(frame.settings)),
      point_spread(show.point_spread, frame.projection, exposure),
      star_saturation(static_cast<float>(show.star_saturation)),
      least_star_radius(show.least_star_radius),
      motion(std::move(sky_motion)),
      stars(stars_of_skies(plan, skies)),
      background(backgrounds_of(show, frame, plan, skies, exposure)),
      disc(disc_light),
      bodies(bodies_at(show, frame.settings)),
      body_times(std::move(times)) {}

FrameScene::FrameScene(const FrameScene& whole, const CubemapFace& face)
    : state(looking_through(whole.state, face)),
      effects(whole.effects),
      plan(whole.plan),
      tracer(state, whole.tracer.lens(), whole.effects),
      exposure(whole.exposure),
      point_spread(whole.point_spread),
      star_saturation(whole.star_saturation),
      least_star_radius(whole.least_star_radius),
      motion(whole.motion),
      stars(whole.stars),
      background(whole.background),
      disc(whole.disc),
      bodies(whole.bodies),
      body_times(looking_through(whole.body_times, face)) {}

}  // namespace domefall
