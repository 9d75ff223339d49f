// These functions read the keys of a trajectory that say how the observer's clock runs.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// A Stage is what a trajectory must know of the segment that it belongs to.
struct Stage {
  std::optional<double> mass_solar;  // none in flat space
  M33d axes;                         // of the reference tetrad on the sky, where the segment begins
  double duration_s = 1;             // of the segment
  const Segment* before = nullptr;   // null for the first segment
  const std::vector<Body>* bodies = nullptr;  // of the show
  double null_time = 0;  // v where the segment begins, counted from the show's start, M
};

// Returns the proper time (units of M; seconds in flat space) that passes in `seconds` of the
// observer's clock.
double proper_time_in(const Stage& stage, double seconds);

// A segment has at most this many orbits.  Their azimuth still has nine digits behind the point.
inline constexpr double kMostOrbits = 1e6;

// A Rate says how proper time runs in the segment.
struct Rate {
  double span = 0;            // proper time that passes in the whole segment
  double begin = 1, end = 1;  // how fast it runs at both ends, as parts of the mean
};

// Reads `rate_m_per_s` (one number, or those at begin and end), `time_lapse` or `orbits`, which
// counts in the given period.  Without any of them 1 M passes per second.  Returns nothing for an
// error.
std::optional<Rate> read_rate(const Section& s, const Stage& stage,
                              std::optional<double> period = std::nullopt);

// Returns the key that says where a segment ends, one of `ends`, or else the key that says how fast
// its clock runs, or null without either.  Reports keys that exclude each other.  Only the two
// rates of `rate_m_per_s: [a, b]` go with an end.
const Item* find_end(const Section& s, std::initializer_list<std::string_view> ends);

// Reads two rates, if there are any, into a timing whose ends are fixed.  Returns true if there was
// no mistake.
bool read_end_rates(const Section& s, const Stage& stage, Timing& timing);

// Reads `pace` into a timing whose ends are fixed.  Reports a pace that the trajectory cannot have.
// Returns true if there was no mistake.
bool read_pace(const Section& s, const Trajectory& trajectory, Timing& timing);

}  // namespace domefall
