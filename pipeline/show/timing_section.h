// The keys of a trajectory that say which part of it a segment shows, and how the observer's clock
// runs meanwhile.
#pragma once

#include <initializer_list>

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"
#include "trajectories/passages.h"

namespace domefall {

// Where a segment happens.
struct Stage {
  std::optional<double> mass_solar;  // nothing: flat space
  M33d axes;                         // of the reference tetrad on the sky, where the segment begins
  double duration_s = 1;             // of the segment
  const Segment* before = nullptr;   // the segment before, if there is one
};

// Proper time (units of M; seconds in flat space) that passes in `seconds`.
double proper_time_in(const Stage& stage, double seconds);

inline constexpr double kNearest = 1e-6, kFarthest = 1e9;  // r, units of M

// How proper time runs in the segment.
struct Rate {
  double span = 0;  // of proper time in the whole segment
  double begin = 1, end = 1;
};

// By `rate_m_per_s` (one number, or those at begin and end), `time_lapse` or `orbits` of that period;
// 1 M per second without any.  Nothing if it is in error.
std::optional<Rate> read_rate(const Section& s, const Stage& stage,
                              std::optional<double> period = std::nullopt);

// How `pace` shapes a run whose ends are fixed: to `timing`.  False, and reported, if the trajectory
// has no such pace.
bool read_pace(const Section& s, const Trajectory& trajectory, Timing& timing);

// Where a segment of a world line begins and ends if the show does not say it.
struct Defaults {
  std::optional<double> tau;                                // nothing: the show must say it
  Leg leg = Leg::kInward;                                   // on which from_r is sought
  double after = -std::numeric_limits<double>::infinity();  // from where on
  // The end; without either 1 M of proper time passes per second.
  std::optional<double> to_r, to_tau;
};

// from_r, from_leg, from_tau_m; to_r, to_leg, to_tau_m, rate_m_per_s, time_lapse; pace.
std::optional<Timing> read_timing(const Section& s, const Stage& stage,
                                  const Trajectory& trajectory, const Defaults& defaults);

// The same for a trajectory that goes on from tau: only the end and the pace are read.
std::optional<Timing> read_end(const Section& s, const Stage& stage, const Trajectory& trajectory,
                               double begin, const Defaults& defaults = {});

}  // namespace domefall
