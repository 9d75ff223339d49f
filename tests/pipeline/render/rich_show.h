// A show with everything that has a layer.
#pragma once

#include <vector>

#include "tests/pipeline/render/scenes.h"

namespace domefall {

inline const std::vector<Layer> kAllLayers{Layer::kSky, Layer::kStars, Layer::kDisc, Layer::kBodies,
                                           Layer::kTitles};

// A map, stars, a disc that hides a part of them, a body, a title.
inline Show rich_show(const Projection& projection) {
  Show show = starry(show_of(StaticObserver{12}, projection));
  show.spacetime = Schwarzschild{4e6};
  show.timeline[0].camera.attitude = LookAtHole{};
  Disc disc{.normal = {V3d(0.3, 0.2, 0.9).normalized()},
            .node = {V3d(0.9, 0, -0.3).normalized()},
            .opacity = 0.7};
  show.disc = disc;
  Body body;
  body.trajectory = CircularOrbit{8};
  body.magnitude = -8;
  show.bodies = {body};
  Title title;
  title.text = "Domefall";
  title.end_s = 1;
  title.elevation = 40 * kDegree;
  title.height = 9 * kDegree;
  title.light = {2, 1, 0.5f};
  title.plate = 0.4;
  title.shadow = 0.6;
  show.titles = {title};
  return show;
}

}  // namespace domefall
