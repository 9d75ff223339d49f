// Finds where the skies end in the camera's view.  Blobs of stars must end there too.
#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "pipeline/render/rays/view_tracer.h"
#include "projections/projection.h"

namespace domefall {

// A PixelBox is a rectangle of a frame's pixels, which are counted from 0.  Both ends belong to it.
struct PixelBox {
  int first_column, last_column, first_row, last_row;
};

// A BorderPolygon is a ViewCurve of many corners.
class BorderPolygon {
 public:
  explicit BorderPolygon(std::vector<V3d> corners);

  // Returns the distance of a direction from it, as a chord.  It is positive on the left side.
  double chord_beyond(const V3d& n) const;
  // Returns a circle around what it encloses, or nothing if that may be more than half of all directions.
  std::optional<ViewCircle> around() const;

 private:
  static constexpr std::size_t kPart = 64;  // so many sides have a ball around them
  struct Part {
    V3d middle;
    double radius;
  };
  const V3d& corner(std::size_t k) const { return corners_[k == corners_.size() ? 0 : k]; }

  std::vector<V3d> corners_;
  std::vector<Part> parts_;
};
using BorderCurve = std::variant<ViewCircle, BorderPolygon>;

// SkyBorders holds the borders of the skies as curves in the view.
class SkyBorders {
 public:
  // Finds the borders of a lensed view.
  SkyBorders(const ViewTracer& tracer, const Projection& projection);

  // Says whether there is a border at which stars must end.  Around a hole of a few pixels there is none.
  bool usable() const { return usable_; }
  // A Sight says what pixels see: every one of them a sky as a whole (kSky), or none of them any
  // (kNoSky).  kBoth stands for all else, and may be given in the other two cases too.
  enum class Sight { kSky, kNoSky, kBoth };
  // Returns the sight of all pixels whose squares lie within an angle `reach` (radians) of n.
  Sight sight_around(const CameraDirection& n, double reach) const;
  // Returns the part of a pixel, 0 to 1, that sees a sky.  The pixel lies in the direction n and
  // covers `pixel_angle` radians.  A border counts as straight within a pixel.
  double part_in_skies(const CameraDirection& n, double pixel_angle) const;
  // Returns that part for each sky by itself.  `seen` says which skies the observer sees.
  PerSky<double> parts(const CameraDirection& n, double pixel_angle,
                       const PerSky<bool>& seen) const;
  // Returns a box that contains all pixels that do not see a sky as a whole, or nothing if the
  // frame has no such pixel.
  std::optional<PixelBox> box_without_sky() const { return box_; }

 private:
  void find_box(const Projection& projection);

  // The sky of each lies where n.axis < cosine, or outside the polygon.
  std::vector<BorderCurve> curves_;
  std::vector<SkyRegion> skies_;   // of each curve
  std::vector<BorderCurve> ends_;  // where the stars of each end
  bool usable_ = true;
  std::optional<PixelBox> box_;
};

}  // namespace domefall
