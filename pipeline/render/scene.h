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

  // Loaded at the first call; files that several regions name are loaded once.  Throws InputError.
  const Sky& sky(SeenSky which);

 private:
  Sky load(SeenSky which) const;
  const RegionSky& region(SeenSky which) const;
  double limit_of(SeenSky which) const;  // magnitude of its faintest stars

  const Show& show_;
  std::mutex loading_;
  std::array<std::unique_ptr<Sky>, kSkies> skies_;
};

}  // namespace domefall
