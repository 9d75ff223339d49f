// trace_kerr() gives one ray near a spinning hole by numbers, for an observer who moves as the tetrad T
// (kerr_start.h).  docs/kerr.md says what is computed.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "pipeline/light/kerr_start.h"
#include "trajectories/directions.h"

namespace domefall {

struct TracedKerr {
  KerrOrigin origin;
  double energy;  // signed; its absolute value is emitted / observed frequency
  // The rest is for light of a sky.
  V3d sky;  // unit vector to where it comes from, with the hole's axis as z
  // That is this one turned by an angle about the axis.  The hole drags light around by the angle, which
  // grows without bound towards the edge, and by many turns where the hole spins nearly as fast as it can.
  V3d undragged;
  double dragged;
  double amplification;  // solid angle seen over solid angle on the sky
  V3d by_delta, across;  // by how much it moves by delta, and by an angle across, sin(delta) eta
  int turns;             // how often cos(theta) was extreme on the way
  double mino;           // Mino time to the sky
  // pi times the half turns of the latitude, and their parts, from the sky to here, each of which takes
  // the same Mino time; without spin this is the azimuth.  It is 0 for light that stays on one side of
  // the equator, which hardly turns.
  double swept;
};
TracedKerr trace_kerr(const KerrPlace& at, const KerrDirection& direction);
// This leaves the amplification out, which takes two fifths of the time.
TracedKerr trace_kerr_without_area(const KerrPlace& at, const KerrDirection& direction);

// A KerrPassage is where a ray crosses the equatorial plane.
struct KerrPassage {
  double r;
  double phi;        // in the coordinates of light that falls, less the observer's, -pi to pi
  double null_time;  // v there, less the observer's
  bool outgoing;     // whether the photon moves outwards there
  double speed;      // its r'/(|E| r^2), by Mino's time
  double mino;       // |E| times Mino's time to the observer
  double energy, angular_momentum;
};
// Returns them as they follow each other back in time, as far as the past horizon, and no more than so
// many.
std::vector<KerrPassage> kerr_passages(const KerrPlace& at, const KerrDirection& direction,
                                       std::size_t most = std::numeric_limits<std::size_t>::max());

// Returns 1 + z of light that matter on a free circle emits at a passage, or nothing where there is no
// such circle.
std::optional<double> circling_shift(const KerrHole& hole, const KerrPassage& at, bool prograde);

}  // namespace domefall
