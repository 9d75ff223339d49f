// The stars that one frame receives: every image whose flux matters.
#pragma once

#include <vector>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene.h"
#include "pipeline/render/star_blobs.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"

namespace domefall {

// An image fainter than this peak pixel value, drawn at its smallest, is left out.
inline constexpr double kFaintestPeak = 2e-4;

// The observed images of one star, brightest possible orders first, before any is drawn.
// Appends to `images` those that may be seen.  `table` is null where light goes straight.
// Without amplification all of a star's images are equally bright, and there is no end of them: the
// two whose light does not go once around the hole are drawn.
class StarImages {
 public:
  // `sky`: what the frame takes of these stars.
  StarImages(const Show& show, const FrameState& state, const Picture::Sky& sky,
             const SkyTable* table);
  void append(const SceneStar& catalogued, std::vector<StarImage>& images) const;

 private:
  bool append_image(const SceneStar& star, const V3d& source, int order,
                    std::vector<StarImage>& images) const;

  SkyImage image(const SceneStar& star, const V3d& source, int order) const;

  Picture::Sky sky_;
  Effects effects_;
  Projection projection_;
  M33d sky_from_tetrad_, tetrad_from_camera_;
  Vantage vantage_;
  Aberration from_tetrad_, to_measured_, from_rest_;
  double straight_ratio_;  // of light that goes straight: gravity's part of the frequency ratio
  const SkyTable* table_;
  double scale_;  // pixel value per cd/m^2
  BlobWidths widths_;
};

}  // namespace domefall
