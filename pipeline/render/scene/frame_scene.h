// A FrameScene is one instant of a show as every stage of its frame reads it: the observer and the
// camera, how light reaches them, the skies that are seen, the bodies near the hole, and how light
// becomes pixel values.  The renderer makes one for each instant, and no later stage derives
// anything from the show again.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/scene/point_spread.h"
#include "pipeline/render/scene/sky_light.h"
#include "pipeline/show/body.h"
#include "pipeline/sources/disc/disc_light.h"
#include "projections/projection.h"

namespace domefall {

// SkyMotion says how the sky moves while a frame lasts.
struct SkyMotion {
  // The rotation vector by which the sky turns against the axes R, Theta, Phi of the tetrad from
  // frame to frame, radians.
  V3d turn{0, 0, 0};
  // The number of frames to the next instant that is seen is 1 with a closed shutter and less with
  // an open one.
  double gap = 1;
};

// BodyTimes give a scene the instants beside its own at which its bodies are seen.
struct BodyTimes {
  double open = 0;            // for so many frames about the instant its light is gathered
  double begin = 0, end = 0;  // frames from the instant to the ends of its segment, <= 0 and >= 0
  // Returns the observer so many frames later, from begin to end.  It is null where bodies are seen
  // at the instant alone.
  std::function<ObserverState(double frames, CameraMotion camera)> at{};
};

struct FrameScene {
  // `skies` has null for a sky that the plan leaves out.  The show, the skies and `disc_light` must
  // outlive the scene.  `disc_light` is the light of the show's disc, or null
  // where the plan has no disc.
  FrameScene(const Show& show, const FrameState& frame, const FramePlan& frame_plan,
             std::shared_ptr<const Lens> lens, const PerSky<const Sky*>& skies,
             SkyMotion sky_motion = {}, const DiscLight* disc_light = nullptr,
             BodyTimes times = {});

  // The face of a cubemap is the same scene in another direction.  Its blobs are as wide as in the
  // whole.
  FrameScene(const FrameScene& whole, const CubemapFace& face);

  const FrameState state;
  const Effects& effects;
  const FramePlan plan;
  const ViewTracer tracer;
  const double exposure;  // the pixel value of 1 cd/m^2
  const PointSpread point_spread;
  const float star_saturation;     // 1 for true colours
  const double least_star_radius;  // angular radius that each star has at least, radians
  const SkyMotion motion;
  const PerSky<const SceneStars*> stars;  // null where the plan has none
  // empty for a sky that is black or has stars only
  const PerSky<std::optional<SkyLight>> background;
  const DiscLight* disc;           // null where none is seen
  const std::vector<Body> bodies;  // all of the show, also where none is seen
  const BodyTimes body_times;

  const Projection& projection() const { return state.projection; }
  // Says whether the lens brightens backgrounds as it does stars.  In nature it does not, since a
  // lens leaves the brightness of surfaces as it is.
  bool amplifies_backgrounds() const { return effects.amplification == Amplification::kEverything; }
};

// Returns the times of the bodies of a show for an instant whose light is gathered for `open` frames.
// The show must outlive them.
BodyTimes body_times(const Show& show, const FrameState& state, double open);

}  // namespace domefall
