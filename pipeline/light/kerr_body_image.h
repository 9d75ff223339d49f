// Finds the images of a body near a spinning hole, each at its retarded place.
//
// The body's way through spacetime meets the observer's past light cone once for each image.  The cells
// of a coarse net of that cone (kerr_cone.h) in which it may do so are looked up, and from there
// Newton's method finds the exact ray.
#pragma once

#include <vector>

#include "pipeline/light/body_image.h"
#include "pipeline/light/kerr_pass.h"

namespace domefall {

// Returns the images in the order in which their light left, the latest first: that is the direct one.
// Of images whose light has swept more than 9 radians (BodyImage::psi, without the turns of space itself)
// the light is dimmed, and beyond 10 none is returned.  `radius` is the body's (M), and bounds its light
// next to a caustic.
std::vector<BodyImage> kerr_body_images(const KerrPlace& at, double null_time,
                                        const BodyMotion& motion, double radius);

// The longer of the sizes of the image of a sphere to first order, radians.
double kerr_size_of_sphere(const BodyImage& image, double radius);

}  // namespace domefall
