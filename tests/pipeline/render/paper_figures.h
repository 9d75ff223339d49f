// The paper's figures as the shows of shows/paper/ have them.  A test asks what is seen where in
// which frame, and the optics and cameras that render the show answer.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/show/attitude.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "tests/source_tree.h"

namespace domefall {

inline constexpr double kOneDegree = std::numbers::pi / 180;
inline constexpr double kLightKmPerS = 299792.458;

inline double angle_between(const V3d& a, const V3d& b) {
  return 2 * std::atan2((a - b).length(), (a + b).length());
}

inline Show figure(const std::string& label) {
  return read_show(source_file("shows/paper/" + label + ".yaml"));
}

// One panel of a figure, which is one frame of its show.  Positions in it are fractions of its
// width and height from the top left.
class Panel {
 public:
  Panel(const Show& show, int frame)
      : state(frame_state(show, frame)), tracer(state, WantedSkies{}, show.effects) {}

  PixelPosition pixel(double x, double y) const {
    return {0.5 + x * columns(state.projection), 0.5 + y * rows(state.projection)};
  }
  ViewRay trace(double x, double y) const {
    return tracer.trace(direction_at(state.projection, pixel(x, y)));
  }
  double z(double x, double y) const { return 1 / trace(x, y).frequency_ratio - 1; }

  // A direction in the observer's frame along the camera's axes: X to the right, Y down, Z ahead.
  V3d in_camera(const V3d& seen) const {
    return apply_transposed(state.observer.tetrad_from_camera, seen);
  }
  // The image of this order of a place on the home sky, along the camera's axes.  Order 0 is the
  // primary image.
  V3d image(const V3d& sky, int order) const {
    const V3d source = apply_transposed(state.observer.sky_from_tetrad, sky);
    const auto points = tracer.lens()->points(own_sky(state.observer), {});
    const V3d in_tetrad = points->image(source, order, 1e-9).direction.v;
    return in_camera(to_observer(state.observer.celerity, in_tetrad).direction);
  }
  V3d hole() const {
    return in_camera(to_observer(state.observer.celerity, V3d(-1, 0, 0)).direction);
  }
  // Whether a direction along the camera's axes lies within the panel.
  bool shows(const V3d& n) const {
    const auto p = pixel_of(state.projection, {n});
    return n.z > -0.9 && p && p->i > 0.5 && p->i < columns(state.projection) + 0.5 && p->j > 0.5 &&
           p->j < rows(state.projection) + 0.5;
  }
  // The speed against the observer at rest at the same r > 2, who moves outwards in the rain frame.
  double local_speed() const {
    const ObserverState& o = state.observer;
    const double s = std::sqrt(2 / o.r), rest_gamma = 1 / std::sqrt(1 - s * s);
    const double gamma =
        std::sqrt(1 + o.celerity.dot(o.celerity)) * rest_gamma - o.celerity.x * rest_gamma * s;
    return std::sqrt((1 - 1 / gamma) * (1 + 1 / gamma));
  }

  FrameState state;
  ViewTracer tracer;
};

inline V3d star(const std::string& name) {
  static const StarCatalogue catalogue =
      read_star_catalogue(source_file("shows/assets/stars_to_8.csv"), 8);
  const auto place = std::ranges::find(catalogue.names, name, &NamedStar::name);
  EXPECT_NE(place, catalogue.names.end()) << name;
  return place == catalogue.names.end() ? V3d(1, 0, 0) : place->direction.v;
}

}  // namespace domefall
