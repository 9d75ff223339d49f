// One instant of a show as every stage of its frame reads it: the observer and the camera, how light
// reaches them, the skies that are seen, and how light becomes pixel values.  The renderer makes one for
// each frame; nothing is derived from the show again below it.
#pragma once

#include <optional>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/scene/point_spread.h"
#include "pipeline/render/scene/sky_light.h"

namespace domefall {

struct FrameScene {
  // skies: what is loaded, null for a sky that the plan leaves out.  Everything that is passed must
  // outlive the scene.
  FrameScene(const Show& show, const FrameState& frame, const FramePlan& frame_plan,
             const HoleOptics& hole_optics, const PerSky<const Sky*>& skies);

  const FrameState& state;
  const Effects& effects;
  const FramePlan plan;
  const HoleOptics& optics;
  const ViewTracer tracer;
  const double exposure;  // pixel value of 1 cd/m^2
  const PointSpread point_spread;
  const PerSky<const SceneStars*> stars;  // null where the plan has none
  const PerSky<std::optional<SkyLight>>
      background;  // nothing for a sky that is black or only stars

  const Projection& projection() const { return state.projection; }
  // Whether the amplification by the lens brightens backgrounds too, against nature.
  bool amplifies_backgrounds() const { return effects.amplification == Amplification::kEverything; }
};

}  // namespace domefall
