// Views of discs for the tests of rendering.
#pragma once

#include <cmath>

#include "pipeline/render/scene/exposure.h"
#include "pipeline/sources/disc/disc.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {

// An observer, and a disc whose normal is given along the observer's R, Theta and Phi.
struct DiscView {
  GivenVelocity at;
  V3d normal{0, -1, 0};
  Disc disc{};
  double charge = 0;
};

// The normal of a disc above whose plane the observer stands by so many degrees.
inline V3d normal_seen_from(double degrees) {
  return {std::sin(degrees * kDegree), -std::cos(degrees * kDegree), 0};
}

// How fast one who rests at r > 2 moves against radial free fall there, or near a charge against T.
inline Celerity<ReferenceTetrad> celerity_of_rest(double r, double charge = 0) {
  if (charge > 0) return {ChargedHole(1, charge).resting_celerity(r), 0, 0};
  const double s = std::sqrt(2 / r);
  return {s / std::sqrt(1 - s * s), 0, 0};
}

// A show of that disc before a black sky.
inline Show disc_show(const DiscView& view, const Projection& projection) {
  Show show = show_of(view.at, projection);
  show.spacetime = Schwarzschild{4.3e6};
  show.disc = view.disc;
  if (view.charge > 0) {
    const ChargedHole hole(4.3e6, view.charge);
    show.spacetime = hole;
    show.disc->orbits = GasOrbits(hole);
  }
  show.disc->normal = {
      apply(frame_state(show, 0).observer.sky_from_tetrad, view.normal.normalized())};
  return show;
}

inline FloatImage render_floats(const Show& show, int threads = 1) {
  FloatImage frame;
  Renderer(show, threads).render(frame_state(show, 0), frame);
  return frame;
}

inline WorkingRgb pixel_at(const FloatImage& frame, int column, int row) {
  const float* at = frame.row(row) + 3 * static_cast<std::ptrdiff_t>(column);
  return {at[0], at[1], at[2]};
}

// The light of a whole frame as illuminance (lux, of pixels at right angles to it).
inline double illuminance(const Show& show, const FloatImage& frame) {
  const FrameState state = frame_state(show, 0);
  double sum = 0;
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column)
      sum += luminance(pixel_at(frame, column, row)) *
             pixel_solid_angle(state.projection, {column + 1.0, row + 1.0});
  return sum / exposure_scale(state.settings);
}

}  // namespace domefall
