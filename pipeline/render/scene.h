// What a show needs loaded, and nothing else: skies and stars by region, made at their first use.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <variant>

#include "pipeline/render/scene_stars.h"
#include "pipeline/render/seen_sky.h"
#include "pipeline/show/show.h"
#include "pipeline/sky/sky_map.h"

namespace domefall {

struct Grid {};
struct Black {};
using Rings = RingsSky;

// The sky of one region.
struct Sky {
  std::variant<Black, Grid, std::shared_ptr<const SkyMap>, Rings> background;
  std::shared_ptr<const SceneStars> stars;  // never null; empty if there are none
};

class Scene {
 public:
  explicit Scene(const Show& show) : show_(show) {}

  // With those of its parts that any call has asked for, loaded at the first one; files that several
  // regions name are loaded once.  Throws InputError.
  const Sky& sky(SeenSky which, bool background = true, bool stars = true);

 private:
  struct Loaded {
    Sky sky{Black{}, std::make_shared<const SceneStars>()};
    bool background = false, stars = false;
  };
  void load_background(SeenSky which);
  void load_stars(SeenSky which);
  const RegionSky& region(SeenSky which) const;
  double limit_of(SeenSky which) const;  // magnitude of its faintest stars

  const Show& show_;
  std::mutex loading_;
  std::array<Loaded, kSkies> skies_;
};

}  // namespace domefall
