// The image of a sphere that is large against its distance from the hole or from the observer,
// traced place by place.
//
// In the frame of free fall at its centre, a sphere is what is at the radius a from there in the
// body's own frame.  Beyond the first order a rigid sphere in a curved space is a convention.  Here
// space is the flat one of the slices of free fall: with X = r n, the places at one time T of these
// slices are
//
//     X(T) + S^-1 L^-1 q,   |q| = a,
//
// where L^-1 contracts along the body's celerity, and S^-1, which is 1 in the rain frame, makes
// lengths along R differences of r.  All places share the motion dX/dT of the centre.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/light/sphere_image.h"
#include "pipeline/spacetime/spacetime.h"

namespace domefall {

// A SphereView says how an observer at r sees places at an instant (Lens::place).
struct SphereView {
  std::function<std::optional<SeenPlace>(double r, double psi)> place;
  const Spacetime& spacetime;  // not a wormhole
  double r;
};

// Returns the image of one order in pieces, as image_of_sphere does.  Each place is seen where it was
// when its light left, and where the ray leaves the surface outwards.  Nothing is returned where a
// part of the sphere is in the hole or does not shine.  Measured against rays that are followed by steps,
// places and rims are within 8e-5 radians, 0.1 pixel of a dome of 4096.
std::optional<std::vector<SpherePiece>> traced_sphere(
    const SphereView& view, const BodyMotion& motion, const BodyImage& image, double radius,
    const std::function<double(const V3d&)>& spacing);

// Returns the same of a sphere with rings.
std::optional<RingedSphere> traced_with_rings(const SphereView& view, const BodyMotion& motion,
                                              const BodyImage& image, double radius,
                                              const RingPlane& rings,
                                              const std::function<double(const V3d&)>& spacing);

// Says whether the observer is within a sphere.  `v` is the observer's, and `tau` a proper time of
// the body near by.
bool is_within_sphere(const Spacetime& spacetime, double r, double v, const BodyMotion& motion,
                      double tau, double radius);

}  // namespace domefall
