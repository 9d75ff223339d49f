// These functions read the keys of a trajectory that name the part of it that a segment shows.
#pragma once

#include <limits>
#include <optional>

#include "pipeline/show/clock_section.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"
#include "trajectories/passages.h"

namespace domefall {

inline constexpr double kNearest = 1e-6, kFarthest = 1e9;  // the radii of shows, units of M
inline constexpr Range kRadius = kUnitsOfM.within(kNearest, kFarthest);

// Defaults say where a segment of a world line begins and ends if the show does not say so.
struct Defaults {
  std::optional<ProperTime> tau;  // of the beginning; none if it must be given
  Leg leg = Leg::kInward;         // on which from_r is sought
  ProperTime after = -std::numeric_limits<double>::infinity();  // tau from which on it is sought
  // The segment ends at one of these.  With neither, 1 M of proper time passes per second.
  std::optional<double> to_r;
  std::optional<ProperTime> to_tau;
};

// Reads the beginning (from_r, from_leg, from_tau_m), the end (to_r, to_leg, to_tau_m,
// rate_m_per_s, time_lapse) and the pace.  Returns nothing for an error.
std::optional<Timing> read_timing(const Section& s, const Stage& stage,
                                  const Trajectory& trajectory, const Defaults& defaults);

// Reads the end and the pace alone, for a trajectory whose beginning is known.
std::optional<Timing> read_end(const Section& s, const Stage& stage, const Trajectory& trajectory,
                               const ProperTime& begin, const Defaults& defaults = {});

}  // namespace domefall
