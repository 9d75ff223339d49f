// Error against run time of every method to find a place along a ray and when its light was there.
// The truth is reference_position.
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
  // Errors, relative ones of r and those of the null time in units of max(1 M, the time itself):
  // the worst, and what 99 of 100 places stay below.
  struct Errors {
    double worst, most;
  } r, time;
  double ns_per_place;  // of one ray by itself
};

// Rays of every class of ray_samples.h, each at a place between 0.02 and 0.98 of its azimuth.  It
// takes 0.2 s if quick, else 6 s.
std::vector<PositionErrorRow> measure_positions(bool quick);

// The time of a frame's places, 128 rays at a time: what a ray takes once, a place on it, and the
// time of light's flight to it.  Nanoseconds by the wall clock, on one thread.
struct PositionSpeed {
  double ray, place, ray_time, place_time;
};
PositionSpeed measure_position_speed();

}  // namespace domefall
