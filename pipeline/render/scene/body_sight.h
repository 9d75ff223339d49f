// Finds where one observer sees the images of a show's bodies.  It serves the renderer, and
// questions about single images.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/light/body_image.h"
#include "pipeline/light/lens.h"
#include "pipeline/light/sphere_surface.h"
#include "pipeline/render/scene/scene_stars.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/viewer.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {

class BodySurface;

class BodySight {
 public:
  // The state and the effects must outlive this object.  Each body has at least the angular radius
  // `least_radius` (radians), as each star has (Show::least_star_radius).
  BodySight(const FrameState& state, const Effects& effects, double least_radius);

  // Says whether bodies, which are in region I, are seen at all.
  bool sees() const;
  // Says whether the lens finds all images of a body together (Lens::lists_bodies).
  bool lists_images() const { return lens_->lists_bodies(); }

  // At most kMostOrders orders are looked for, and kFaintOrders in succession that are too faint
  // end the search.  An image is fainter by e^(-2 pi) than the one two orders before it, which is
  // on the same side of the hole, but one side may be bright while the other is faint.
  static constexpr int kMostOrders = 24, kFaintOrders = 3;

  // Returns the star that has the light of the body at kBodyMagnitudeDistance.
  static SceneStar star_of(const Body& body);

  // Returns the first order that is seen.  An observer who rides a body of no size sees only the
  // light that it sent around the hole before.  One who is within a sphere sees nothing of it.
  int first_order(const Body& body) const;
  // Says whether the body has a direct image that is left out for this reason.
  bool is_too_near(const Body& body) const;

  // An Image is the image of one order in the tetrad.  Its amplification refers to the light of
  // star_of(body).
  struct Image {
    SkyImage at;
    BodyImage traced;
  };
  // `emitted` is a proper time of the body (BodyImage::proper_time) near which its light may have
  // left.
  std::optional<Image> image(const Body& body, int order,
                             const std::optional<double>& emitted = {}) const;

  // Returns the pieces in which an image is drawn that is too large for one blob of width sigma
  // (radians, for the camera).  Such an image is that of a sphere, an arc or a part of a ring.
  // There are no pieces where one blob is enough, nor where images are not amplified.
  struct Piece {
    SkyImage at;
    WorkingRgb tint{1, 1, 1};
    double solid_angle = 0;  // that it covers in the frame of `at`, steradians; 0 of a point
  };
  // They are right to 0.1 pixel, or to one in a trail, which is blurred.
  std::vector<Piece> pieces(const Body& body, const Image& image, double sigma,
                            bool in_trail = false) const;

  // A Seen describes an image as the camera receives it.  `brightening` is the bolometric flux, as
  // the renderer draws it, over that of star_of(body).  The frequency ratio is the one that is
  // measured.
  struct Seen {
    CameraDirection direction;
    double brightening, frequency_ratio;
    double doppler;  // frequency for who sees it over that in the tetrad
  };
  Seen seen(const SkyImage& image) const;

  // Returns how far the image of a body, or of its rings, reaches from its middle at most (radians, for
  // the camera; to first order, and at most pi/8).  It is 0 for a point.
  double reach(const Body& body, const Image& image) const;

  // Returns the V of an image as it is drawn.
  double seen_v(const Body& body, const SkyImage& at, const std::vector<Piece>& pieces) const;

  // Returns the image that looks to the observer of `other` as this one does to this observer.
  SkyImage moved_to(const BodySight& other, const SkyImage& image) const;

  // Of two images in one direction the one of which this is greater is behind the other.
  double far(const Body& body, const BodyImage& image) const;

  // Returns the radius of a body, M.  A body without a size of its own is as large as its light
  // needs.  Like a star, it has a least size, which bounds its light on the axis of the lens.
  double radius_of(const Body& body) const;

 private:
  std::optional<BodyImage> traced(const Body& body, int order,
                                  const std::optional<double>& emitted = {}) const;
  // All images of a body, of a lens that lists them, which are found once.
  const std::vector<BodyImage>& listed(const Body& body) const;
  double size_of(const BodyImage& image, double radius) const;
  double observer_v() const;
  // Says whether large spheres are traced place by place.
  bool is_traced() const;
  RingedSphere sphere(const Body& body, const BodyImage& image, const BodySurface& surface,
                      double error, const std::function<double(const V3d&)>& spacing) const;

  const Effects& effects_;
  const ObserverState& observer_;
  Viewer viewer_;
  std::shared_ptr<const Lens> lens_;
  double least_radius_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::vector<BodyImage>> listed_;  // by their names
};

// Says whether a body of this magnitude is bright enough to be seen in a frame with these settings,
// by an image with this brightening.  Images that are fainter than the stars of a default sky are
// not.
bool is_bright(double magnitude, double brightening, const FrameSettings& settings);

}  // namespace domefall
