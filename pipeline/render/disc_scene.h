// A DiscScene is the scene of one instant with its disc and nothing else, of which single rays are
// asked.
#pragma once

#include <optional>

#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {

struct DiscScene {
  // The lens knows all three skies, lit or not.  `show` and `state` must outlive this object.
  DiscScene(const Show& show, const FrameState& state)
      : plan(plan_without_skies(show, state)),
        light(plan.disc ? std::optional<DiscLight>(*show.disc) : std::nullopt),
        scene(show, state, plan,
              lens_of(state.observer, WantedSkies{{true, true, true, true}}, show.effects), {}, {},
              light ? &*light : nullptr) {
    if (light) disc.emplace(scene);
  }
  ~DiscScene() = default;
  DiscScene(const DiscScene&) = delete;
  DiscScene& operator=(const DiscScene&) = delete;

  // As DiscPass::left_before, and 1 without a disc.
  double left_before(const CameraDirection& n, double psi, double width) const {
    return disc ? disc->left_before(n, psi, width) : 1;
  }

  FramePlan plan;
  std::optional<DiscLight> light;
  FrameScene scene;
  std::optional<DiscPass> disc;

 private:
  static FramePlan plan_without_skies(const Show& show, const FrameState& state) {
    FramePlan plan = plan_frame(show, state);
    plan.sky = {};
    return plan;
  }
};

}  // namespace domefall
