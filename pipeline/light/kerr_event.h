// An event on a ray near a spinning hole, from which its light left, and by how much the event moves
// where one looks elsewhere.  All is told in the reference tetrad of that place.
#pragma once

#include <optional>

#include "pipeline/light/kerr_start.h"
#include "trajectories/directions.h"

namespace domefall {

// A vector of spacetime by its components along T and along R, Theta and Phi.
struct TetradVector {
  double t = 0;
  V3d s{0, 0, 0};

  TetradVector operator+(const TetradVector& b) const { return {t + b.t, s + b.s}; }
  TetradVector operator*(double f) const { return {t * f, s * f}; }
  // Returns the product of the metric, positive for what is timelike.
  double dot(const TetradVector& b) const { return t * b.t - s.dot(b.s); }
};

// A KerrSpot is a place by r and the unit vector to it, whose z is the hole's axis and whose angle about
// it is that of light that falls.
struct KerrSpot {
  double r;
  V3d place;
};
// The axes of the tetrad there: R, Theta and Phi, as directions like the place.
M33d kerr_axes(const V3d& place);
// Returns a small step in r, of the place and in v, along the tetrad.
TetradVector tetrad_vector(const KerrHole& hole, const KerrSpot& at, double by_r,
                           const V3d& by_place, double by_v);
// Returns by how much v grows along a vector.
double null_time_along(const KerrHole& hole, const KerrSpot& at, const TetradVector& vector);

struct KerrEvent {
  KerrSpot at;       // its angle counts from the observer's
  double null_time;  // v there, less the observer's
  double energy;     // abs(E)
  double sigma;
  double swept;        // kappa times the Mino time, radians
  TetradVector light;  // the photon over abs(E)
  // By how much it moves by delta, and by an angle across, sin(delta) eta, beside a multiple of `light`:
  // these steps stay on the observer's past light cone, and the Mino time grows with them.
  TetradVector by_delta, across;
  double mino_by_delta, mino_across;
};

// Returns the event after a Mino time (times abs(E), > 0), or nothing where the ray ends before, or
// leaves region I or II.
std::optional<KerrEvent> kerr_event(const KerrPlace& at, const KerrDirection& direction,
                                    double mino);

}  // namespace domefall
