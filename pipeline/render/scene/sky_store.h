// What a show needs loaded, and nothing else: skies and stars by region, made at their first use.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <variant>

#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/scene/scene_stars.h"
#include "pipeline/show/show.h"
#include "pipeline/sky/maps/sky_map.h"
#include "trajectories/sky_region.h"

namespace domefall {

struct Grid {};
struct Black {};
using Rings = RingsSky;

// The sky of one region.
struct Sky {
  std::variant<Black, Grid, std::shared_ptr<const SkyMap>, Rings> background;
  std::shared_ptr<const SceneStars> stars;  // never null; empty if there are none
};

class SkyStore {
 public:
  explicit SkyStore(const Show& show) : show_(show) {}

  // With those of its parts that any call has asked for, loaded at the first one; files that several
  // regions name are loaded once.  Throws InputError.
  const Sky& sky(SkyRegion which, bool background = true, bool stars = true);
  // The skies that a plan asks for; null for the others.
  PerSky<const Sky*> skies_of(const FramePlan& plan);

 private:
  struct Loaded {
    Sky sky{Black{}, std::make_shared<const SceneStars>()};
    bool background = false, stars = false;
  };
  void load_background(SkyRegion which);
  void load_stars(SkyRegion which);
  const RegionSky& region(SkyRegion which) const;
  double limit_of(SkyRegion which) const;  // magnitude of its faintest stars

  const Show& show_;
  std::mutex loading_;
  PerSky<Loaded> skies_;
};

}  // namespace domefall
