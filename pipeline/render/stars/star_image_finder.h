// A StarImageFinder finds the images of stars in one frame that are bright enough to be seen.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/light/aberration.h"
#include "pipeline/light/sky_points.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/render/stars/star_loops.h"
#include "pipeline/render/stars/star_trail.h"

namespace domefall {

// An image is left out if its blob, drawn at the smallest size, has a peak pixel value below this.
inline constexpr double kFaintestPeak = 2e-4;

// The stars are those of one sky.  Where light goes straight, a star has one image.  Without
// amplification, a star has infinitely many images of equal brightness.  Of these, only the two are
// found whose light does not go around the hole.
//
// Near the axis of the lens an image is bright and fast.  Where the sky turns, the image is the
// mean over the time of a frame (star_trail.h).  Where the sky stands still, a star is an arc or a
// ring if it is so near to the axis that its own disc matters (SkyPoints::arc).
//
// Stars are found in batches by the lens (sky_points.h) and loops that become SIMD code
// (star_loops.h).  This part of the class is star_image_finder_batches.cpp.  Images near the axis,
// images of high orders and those of frames without some effect are found one star at a time, in
// star_image_finder.cpp.
class StarImageFinder {
 public:
  // The scene must outlive this object.
  StarImageFinder(const FrameScene& scene, SkyRegion sky);

  // Appends the images of one star that are bright enough.  Some of them may lie outside the frame.
  // Each order is exact and slow.
  void append(const SceneStar& catalogued, std::vector<StarImage>& images) const;

  // Appends one image that was found elsewhere.  No gain or limit is applied to the star.  Returns
  // whether the image is bright enough, even if it is outside the frame.
  bool append_image(const SceneStar& star, const SkyImage& image,
                    std::vector<StarImage>& images) const;

  // Does the same with an image or a trail in pieces, which is bright enough if all of its light in one
  // blob would be.  Tints are factors to the light of each, or none.
  bool append_pieces(const SceneStar& star, const std::vector<SkyImage>& pieces,
                     std::vector<StarImage>& images,
                     const std::vector<WorkingRgb>& tints = {}) const;

  // Returns how many stars, counted from the first, may be bright enough by their magnitudes and
  // fluxes.
  std::size_t count(const SceneStars& stars) const;
  // Appends the images of a batch.  It begins with the star `first`, a multiple of kStarBatch, and
  // stops at the end of the batch or before `end`.  Images differ from those of single stars by 0.01
  // pixel and 1e-4 of the light.  Those whose blobs do not reach the frame
  // are left out.
  void append(const SceneStars& stars, std::size_t first, std::size_t end,
              std::vector<StarImage>& images) const;

 private:
  struct Received {
    StarImage image;
    double peak;  // pixel value of the smallest blob with this light
    bool placed;  // whether the projection has a place for it
  };
  struct Batch;

  std::optional<SceneStar> with_gain(const SceneStar& catalogued) const;
  // Returns the path of a source that passes near the axis while the frame lasts, or nothing.
  std::optional<AxisPassage> passage_of(const SceneStar& star, const V3d& source) const;
  bool append_order(const SceneStar& star, const V3d& source,
                    const std::optional<AxisPassage>& passage, int order,
                    std::vector<StarImage>& images) const;
  bool append_trail(const SceneStar& star, const StarTrail& trail,
                    std::vector<StarImage>& images) const;
  bool append_trail_in_batches(const SceneStar& star, const StarTrail& trail,
                               std::vector<StarImage>& images) const;
  // Returns the length of part k of a trail in the camera's view, in units of the least sigma.
  double sigmas_of(const StarTrail& trail, std::size_t k) const;
  // Returns the number of pieces for a part of a trail that is `sigmas` long.  `peak` is the peak
  // that its light would have in one piece.  Raises `brightest` to the peak of the row of pieces if
  // that is higher.
  static int pieces_of(double sigmas, double peak, double& brightest);
  // Returns the least sigma of the frame about a direction, in radians before the boost.
  double least_sigma_at(const V3d& direction) const;
  void append_listed(const SceneStar& star, std::vector<StarImage>& images) const;
  void append_orders(const SceneStar& star, const V3d& source, int first, int end,
                     std::vector<StarImage>& images) const;
  Received receive(const SceneStar& star, const SkyImage& at,
                   const WorkingRgb& tint = {1, 1, 1}) const;
  double radius_of(const SceneStar& star) const;
  double least_sine(const SceneStar& star, const V3d& source,
                    const std::optional<AxisPassage>& passage) const;
  bool is_arc(const SceneStar& star, const V3d& source) const;
  SkyImage image(const SceneStar& star, const V3d& source, int order) const;

  void prepare_batches();
  void append_batch(Batch& batch, int order, std::vector<StarImage>& images) const;
  void set_aside_axis(Batch& batch, double most_radius) const;
  void drop_faint(Batch& batch, int order) const;
  void set_aside_high_orders(Batch& batch) const;
  void append_views(StarViews& views, int count, double least_peak,
                    std::vector<StarImage>& images) const;
  void append_exact(const SceneStars& stars, const Batch& batch,
                    std::vector<StarImage>& images) const;

  const FrameScene& scene_;
  const FrameSettings::Sky& sky_;  // gain and limit of these stars
  const ObserverState& observer_;
  M33d axes_;  // of R, Theta and Phi on the sky
  const Viewer& viewer_;
  std::unique_ptr<const SkyPoints> points_;  // null where the lens has no table of the sky
  Aberration from_tetrad_, to_measured_;
  double peak_per_lux_;  // pixel value of the peak of the smallest blob
  double stretch_;       // gamma + |celerity|, the most by which the boost stretches angles
  bool has_caustics_;    // whether the lens brightens stars without bound near its axis
  double near_;          // sine of the angle from the axis within which images may be trails
  bool in_batches_;      // whether stars are found in batches

  // The members below are used if stars are found in batches.
  StarFrame batch_frame_;
  StarPlane plane_;
  // An image is too faint if this times its flux is below 1, where the flux includes the factor
  // amplification/(1+z)^4 in the tetrad.
  double brightness_per_flux_ = 0;
  // A star is too faint in an order and all that follow if the order's bound times the star's flux
  // is below the sine of its angle from the axis.
  std::vector<double> bound_;
};

}  // namespace domefall
