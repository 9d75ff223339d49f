// An observer with the tables of light, for the tests of stars.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/light/hole_optics.h"
#include "pipeline/render/scene/exposure.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {

// The observer's camera faces the hole, which stands 45 degrees high on a dome.
class StarScene {
 public:
  // `ev` is the exposure in stops.
  StarScene(const GivenVelocity& at, const Projection& projection, double ev = 0)
      : show(show_of(at, projection)), state(frame_state(show, 0)) {
    state.settings.ev = ev;
    state.settings.sky[SkyRegion::kI].max_magnitude =
        state.settings.sky[SkyRegion::kIII].max_magnitude = 99;
    optics = make_hole_optics(at.r, at.tetrad, {});
  }

  bool has(bool far) const { return table(far) != nullptr; }
  SkyRegion region(bool far) const {
    return own_sky(far ? mirror_of(optics.tetrad) : optics.tetrad, 0);
  }
  const SkyTable* table(bool far) const { return optics.table_of(region(far)); }
  double exposure() const { return exposure_scale(state.settings); }
  PointSpread point_spread() const { return {show.point_spread, state.projection, exposure()}; }
  StarImageFinder images(bool far = false) const {
    scenes_.push_back(std::make_unique<FrameScene>(scene_with(show, state, {}, motion)));
    return {*scenes_.back(), region(far)};
  }
  // The direction on the sky that has these components along R, Theta, Phi.
  SkyDirection sky(const V3d& source) const {
    return {apply(state.observer.sky_from_tetrad, source.normalized())};
  }

  Show show;
  FrameState state;
  HoleOptics optics;
  SkyMotion motion;

 private:
  mutable std::vector<std::unique_ptr<FrameScene>> scenes_;  // images() refers to them
};

// The images of all stars, found in batches as lay_stars() does.
inline std::vector<StarImage> all_images(const StarImageFinder& maker, const SceneStars& stars) {
  std::vector<StarImage> images;
  const std::size_t count = maker.count(stars);
  for (std::size_t k = 0; k < count; k += kStarBatch) maker.append(stars, k, count, images);
  return images;
}

// The luminance of an image's light, in the units of StarImage::rgb.
inline double light(const StarImage& image) {
  return luminance({image.rgb[0], image.rgb[1], image.rgb[2]});
}

inline double total_light(const std::vector<StarImage>& images) {
  double sum = 0;
  for (const StarImage& image : images) sum += light(image);
  return sum;
}

}  // namespace domefall
