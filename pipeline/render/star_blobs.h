// Stars as they appear in one frame: every image whose flux matters, as a blob in angle.
#pragma once

#include <vector>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"

namespace domefall {

// A truncated Gaussian in angle about a direction: weight exp(-q) - exp(-q_max), q = c^2/(2 sigma^2),
// c the chord to the centre, out to kBlobReach sigma; zero and continuous at its end.
struct StarBlob {
  CameraDirection centre;
  double sigma;  // radians
  float rgb[3];  // pixel value times solid angle: the blob's sum over pixels of value * solid angle
  float norm;    // 1 / (integral of the weight over the sphere)
  int first_row, last_row, first_column, last_column;  // pixels from 0, clipped to the image
};

inline constexpr double kBlobReach = 4.5;

// The peak of a narrower blob would change by a third or more as it drifts across pixels: stars
// would twinkle.
inline constexpr double kLeastSigmaPixels = 0.9;

// Fills norm and the pixels that a blob of given centre and sigma covers; false if none is in the
// picture.  Its weights' sum is that of a blob in the open: a star at the rim is cut, not dimmed.
bool place_blob(const Projection& projection, StarBlob& blob);

// An image fainter than this peak pixel value, drawn at its smallest, is left out.
inline constexpr double kFaintestPeak = 2e-4;

// The observed images of one star, brightest possible orders first, before any blob is made.
// Appends to `blobs` those that fall into the picture.  `table` is null where light goes straight.
// Without amplification all of a star's images are equally bright, and there is no end of them: the
// two whose light does not go once around the hole are drawn.
class BlobMaker {
 public:
  // `sky`: what the frame takes of these stars.
  BlobMaker(const Show& show, const FrameState& state, const Picture::Sky& sky,
            const SkyTable* table);
  void append(const SceneStar& catalogued, std::vector<StarBlob>& blobs) const;

 private:
  bool append_image(const SceneStar& star, const V3d& source, int order,
                    std::vector<StarBlob>& blobs) const;

  SkyImage image(const SceneStar& star, const V3d& source, int order) const;

  const StarBlobs& law_;
  Picture::Sky sky_;
  Effects effects_;
  Projection projection_;
  M33d sky_from_tetrad_, tetrad_from_camera_;
  Vantage vantage_;
  Aberration from_tetrad_, to_measured_, from_rest_;
  double straight_ratio_;  // of light that goes straight: gravity's part of the frequency ratio
  const SkyTable* table_;
  double scale_;      // pixel value per cd/m^2
  double min_sigma_;  // radians, at least 0.9 pixel
  double max_sigma_;
};

// Adds the part of a blob that lies on row `row` (from 0) to rgb[3 * columns].
void draw_row(const StarBlob& blob, const Projection& projection, int row, float* rgb);

}  // namespace domefall
