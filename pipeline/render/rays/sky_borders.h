// Where the skies end in the camera's view, which is where blobs of stars must end too.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/optics/hole_optics.h"
#include "pipeline/render/rays/view_circle.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"
#include "projections/projection.h"

namespace domefall {

// A part of a frame's pixels, both ends included.
struct PixelBox {
  int first_column, last_column, first_row, last_row;
};

// The borders are circles about the line through the hole, and a boost makes circles of circles.
class SkyBorders {
 public:
  // The borders of a lensed view.
  SkyBorders(const FrameState& state, const HoleOptics& optics, const Vantage& vantage);

  // Whether there is a border, and none is so small that a pixel might hold all of it.
  bool usable() const { return usable_; }
  // What all pixels see whose squares lie within an angle `reach` (radians) of a direction: a sky,
  // or none, each of them as a whole.  kBoth may also stand for one of the two.
  enum class Sight { kSky, kNoSky, kBoth };
  Sight sight_around(const CameraDirection& n, double reach) const;
  // The part of a pixel, 0 to 1, that sees a sky, where its direction is n and it covers an angle
  // in radians.  A border counts as straight within a pixel.
  double part_in_skies(const CameraDirection& n, double pixel_angle) const;
  // The pixels among which are all that do not see a sky as a whole, or nothing if the frame has
  // none.
  std::optional<PixelBox> box_without_sky() const { return box_; }

 private:
  void find_box(const Projection& projection);

  std::vector<ViewCircle> circles_;  // each with its sky where n.axis < cosine
  bool usable_ = true;
  std::optional<PixelBox> box_;
};

}  // namespace domefall
