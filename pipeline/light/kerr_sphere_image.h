// The image of a sphere near a spinning hole, ray by ray.
//
// From the middle of the image on, over a net of directions, each exact ray is followed to where it is
// nearest to the sphere's centre.  There it is off by a length at right angles to the light, in the
// body's own frame, and hits if that is less than the radius.  Between the rays of the net the lens is
// taken to first order.  So arcs and rings come out as they are, and images that have grown into one are
// one.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "pipeline/light/kerr_pass.h"
#include "pipeline/light/sphere_image.h"

namespace domefall {

// Returns the pieces of an image (image_of_sphere), and of its rings.  `earlier` has the images whose
// pieces are already there.  Where this image is one with one of them, a single piece without light is
// returned.  Images of light that winds around the hole, which are thin beside the spacing, are lines along
// the silhouette's edge.
RingedSphere kerr_image_of_sphere(const KerrPlace& at, double null_time, const BodyMotion& motion,
                                  const BodyImage& image, std::span<const BodyImage> earlier,
                                  double radius, const RingPlane& rings,
                                  const std::function<double(const V3d&)>& spacing);

}  // namespace domefall
