// Where one observer sees the images of a show's bodies: for the renderer, and for questions about
// single ones.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/optics/body_image.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/scene/scene_stars.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"

namespace domefall {

class BodySight {
 public:
  // The show and the state must outlive this.
  BodySight(const Show& show, const FrameState& state);

  // Whether bodies, which are in region I, are seen at all.
  bool sees() const;

  // As many orders as are looked for at most, and so many in succession that are too faint end the
  // search: each second one is fainter by e^(-2 pi), and either side of the hole may be bright.
  static constexpr int kMostOrders = 24, kFaintOrders = 3;

  // The star that has the body's light at kBodyMagnitudeDistance.
  static SceneStar star_of(const Body& body);

  // The first order that is seen.  Who rides a body of no size does not see it, but for the light
  // that it sent around the hole before; who is within a sphere sees nothing of it.
  int first_order(const Body& body) const;

  // The image of an order in the tetrad; its amplification is over the light of that star.
  struct Image {
    SkyImage at;
    BodyImage traced;
  };
  std::optional<Image> image(const Body& body, int order) const;

  // The pieces of which an image is drawn that is too large for one blob of width sigma (radians,
  // for the camera): of a sphere, an arc, a part of a ring.  None where one blob is enough, and
  // where images are not amplified.
  std::vector<SkyImage> pieces(const Body& body, const Image& image, double sigma) const;

  // The same for the camera, with the flux over that star's as the renderer draws it, and the
  // frequency ratio that is measured.
  struct Seen {
    CameraDirection direction;
    double brightening, frequency_ratio;
  };
  Seen seen(const SkyImage& image) const;

 private:
  double radius_of(const Body& body) const;
  std::optional<BodyImage> traced(const Body& body, int order) const;

  const Show& show_;
  const ObserverState& observer_;
  Vantage vantage_;
};

}  // namespace domefall
