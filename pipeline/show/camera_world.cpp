#include "pipeline/show/camera_world.h"

#include "pipeline/show/attitude.h"
#include "projections/projection.h"

namespace domefall {
namespace {

// Turns the components of vectors along R, Theta and Phi into those along x, y and z of the world,
// and these into those.
M33d in_other(const M33d& axes) {
  const auto turned = [](const V3d& v) { return V3d(v.z, -v.y, v.x); };
  return from_columns(turned(column(axes, 0)), turned(column(axes, 1)), turned(column(axes, 2)));
}

// Returns the axes of a picture, to the right, up and out of it towards the eye, along the axes of
// its projection's camera.
M33d picture_axes(const Projection& projection) {
  const bool front_in_middle = has_zenith(projection) && !traits_of(projection).is_dome;
  return front_in_middle ? from_columns({1, 0, 0}, {0, 0, 1}, {0, -1, 0})
                         : from_columns({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
}

}  // namespace

M33d world_from_camera(const ObserverState& observer, const Projection& projection) {
  return in_other(base_from_camera(observer) * picture_axes(projection));
}

M33d world_from_audience(const FrameState& state) {
  // Right, front and zenith become right, zenith and back.
  const M33d turned = from_columns({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
  return in_other(base_from_camera(state.observer) * state.camera_from_audience * turned);
}

M33d base_from_camera(const M33d& world_from_camera, const Projection& projection) {
  return in_other(world_from_camera) * picture_axes(projection).transposed();
}

}  // namespace domefall
