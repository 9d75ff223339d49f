// measure_positions() gives error against run time of every method that finds a place along a ray
// and when its light was there.  The truth is reference_position().
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct PositionErrorRow {
  bool at_edge;        // rays 1e-12 to 1e-3 radians beside an edge, or else all others
  std::string method;  // as in `domefall trace --method`
  double tolerance;    // of an integrator, else 0
  int places;
  int missing;  // for which the method found no place; these are not in the errors
  // The errors of r are relative, and those of the null time are in units of max(1 M, the time
  // itself).  `worst` is the largest, and 99 of 100 places are right to within `most`.
  struct Errors {
    double worst, most;
  } r, time;
  double ns_per_place;  // of one ray by itself
};

// Measures rays of every class of ray_samples.h, each at one place between 0.02 and 0.98 of the
// azimuth that it sweeps.  This takes 0.2 s if quick, else 6 s.
std::vector<PositionErrorRow> measure_positions(bool quick);

// A PositionSpeed is what places cost in a frame, where 128 rays are taken at a time.  `ray` is the
// part done once for each ray, and `place` is the part for each place on it.  `ray_time` and
// `place_time` are the same for the time of light's flight.  All are in nanoseconds by the wall
// clock, on one thread.
struct PositionSpeed {
  double ray, place, ray_time, place_time;
};
PositionSpeed measure_position_speed();

}  // namespace domefall
