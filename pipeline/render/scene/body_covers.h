// What the spheres of a frame's bodies hide, for questions about single directions.
#pragma once

#include <span>
#include <vector>

#include "pipeline/render/scene/body_sight.h"

namespace domefall {

class BodyCovers {
 public:
  // Spheres are drawn in blobs of this width (radians; PointSpread::least).
  BodyCovers(const BodySight& sight, std::span<const Body> bodies, double sigma);

  // Returns the part of light from beyond `far` (BodySight::far) that spheres let through: 1 where
  // none is, 0 behind one.  At its edge a sphere is as soft as it is drawn.
  double left_before(const CameraDirection& direction, double far) const;

 private:
  struct Piece {
    CameraDirection direction;
    double solid_angle;  // for the camera
  };
  struct Cover {
    double far;
    std::vector<Piece> pieces;
  };
  std::vector<Cover> covers_;
  double sigma_;
};

}  // namespace domefall
