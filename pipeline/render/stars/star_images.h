// The stars that one frame receives: every image whose flux matters.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/scene/sky_store.h"
#include "pipeline/render/stars/star_loops.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"

namespace domefall {

// An image fainter than this peak pixel value, drawn at its smallest, is left out.
inline constexpr double kFaintestPeak = 2e-4;

// The observed images of stars, before any is drawn.  `table` is null where light goes straight.
// Without amplification all of a star's images are equally bright, and there is no end of them: the
// two whose light does not go once around the hole are drawn.
//
// Near the axis of the lens, where points would be infinitely bright, a star is a disc as large as
// the least of blobs would cover there: an arc or a ring (star_arcs.h).
class StarImages {
 public:
  // `sky`: what the frame takes of these stars.
  StarImages(const Show& show, const FrameState& state, const FrameSettings::Sky& sky,
             const SkyTable* table);

  // One star, every order by inverting the table: exact, slow.  Appends the images that may be seen,
  // and some that lie beside the picture.
  void append(const SceneStar& catalogued, std::vector<StarImage>& images) const;

  // How many of the stars may be seen at all, by their magnitudes and fluxes: the first ones.
  std::size_t count(const SceneStars& stars) const;
  // The stars first to first + kStarBatch - 1, or up to `end`: the same images but for LensCurve's
  // errors (0.01 pixel, 1e-4 of the light), and none from which no blob reaches the picture.
  // first: a multiple of kStarBatch.
  void append(const SceneStars& stars, std::size_t first, std::size_t end,
              std::vector<StarImage>& images) const;

 private:
  static constexpr int kLastOrder = 24, kCurves = 4;
  struct Received {
    StarImage image;
    double peak;  // of the narrowest blob with its light
    bool placed;  // the picture has a place for it
  };
  struct Batch;

  std::optional<SceneStar> taken(const SceneStar& catalogued) const;
  bool append_order(const SceneStar& star, const V3d& source, int order,
                    std::vector<StarImage>& images) const;
  bool append_arc(const SceneStar& star, const V3d& source, int order,
                  std::vector<StarImage>& images) const;
  void append_orders(const SceneStar& star, const V3d& source, int first, int end,
                     std::vector<StarImage>& images) const;
  Received receive(const SceneStar& star, const SkyImage& at) const;
  bool may_be_seen(const SceneStar& star, double sine, int order) const;
  bool is_arc(const V3d& source, int order) const;
  SkyImage image(const SceneStar& star, const V3d& source, int order) const;

  void prepare_batches();
  void append_curved(Batch& batch, int order, std::vector<StarImage>& images) const;
  void leave_axis(Batch& batch) const;
  void keep_bright(Batch& batch, int order) const;
  void leave_orders_beyond(Batch& batch) const;
  void append_views(StarViews& views, int count, std::vector<StarImage>& images) const;
  void append_exact(const SceneStars& stars, const Batch& batch,
                    std::vector<StarImage>& images) const;

  FrameSettings::Sky sky_;
  Effects effects_;
  Projection projection_;
  M33d sky_from_tetrad_, tetrad_from_camera_;
  Vantage vantage_;
  Aberration from_tetrad_, to_measured_, from_rest_;
  double straight_ratio_;  // of light that goes straight: gravity's part of the frequency ratio
  const SkyTable* table_;
  double scale_;  // pixel value per cd/m^2
  PointSpread widths_;
  double peak_per_lux_;

  double stretch_;  // gamma + |celerity|: by how much the boost widens angles, or compresses them
  double disc_;     // radius of a star near the axis
  bool plain_;      // no effect is left out, no vantage but the observer's own

  StarFrame batch_frame_;
  StarPlane plane_;
  std::vector<LensCurve> curves_;
  // A star with flux * per_flux_ * (amplification * (1+z)^-4 in the tetrad) below 1 is too faint.
  double per_flux_ = 0;
  // By order: one with flux * bound below the sine of its angle from the axis is too faint in this
  // order and in all that follow.
  std::array<double, kLastOrder> bound_{};
};

}  // namespace domefall
