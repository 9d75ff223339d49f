// The stars that one frame receives: every image whose flux matters.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/render/stars/star_loops.h"

namespace domefall {

// An image fainter than this peak pixel value, drawn at its smallest, is left out.
inline constexpr double kFaintestPeak = 2e-4;

// The observed images of stars, before any is drawn.  Where light goes straight a star has one
// image.  Without amplification all images of a star are equally bright and there is no end of
// them, so that only the two are drawn whose light does not go once around the hole.
//
// Near the axis of the lens, where points would be infinitely bright, a star is a disc as large as
// the smallest blob would cover there.  Its image is an arc or a ring (star_arcs.h).
class StarImages {
 public:
  // The images of the stars of one sky.  The scene must outlive this.
  StarImages(const FrameScene& scene, SkyRegion sky);

  // One star, every order by inverting the table: exact, slow.  Appends the images that may be
  // seen, and some that lie beside the picture.
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

  const FrameScene& scene_;
  const FrameSettings::Sky& sky_;  // what the frame takes of these stars
  const ObserverState& observer_;
  const Vantage& vantage_;
  const SkyTable* table_;  // null where light goes straight
  Aberration from_tetrad_, to_measured_, from_rest_;
  double straight_ratio_;  // gravity's part of the frequency ratio where light goes straight
  double peak_per_lux_;    // of the smallest blob
  double stretch_;         // gamma + |celerity|: by how much the boost widens or compresses angles
  double disc_;            // radius of a star near the axis, radians
  bool plain_;             // no effect is left out, and the vantage is the observer's own

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
