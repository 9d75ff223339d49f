// The keys of a segment's `trajectory`.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Where a segment happens.
struct Stage {
  std::optional<double> mass_solar;  // nothing: flat space
  SkyDirection hole_at;
  double heading = 0;     // radians
  double azimuth = 0;     // radians swept before the segment
  double duration_s = 1;  // of the segment
};

struct TimedTrajectory {
  Trajectory trajectory;
  double tau_begin = 0, tau_end = 0;
  Pace pace = Pace::kSteady;
};

std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup);

// Proper time (units of M; seconds in flat space) that passes in `seconds`.
double proper_time_in(const Stage& stage, double seconds);

}  // namespace domefall
