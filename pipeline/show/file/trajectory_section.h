// The section `trajectory` of a segment says how its observer moves.
#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "pipeline/show/file/lookup.h"
#include "pipeline/show/file/section.h"
#include "pipeline/show/show.h"
#include "trajectories/trajectory.h"

namespace domefall {

// A Stage is what a trajectory must know of the segment that it belongs to.
struct Stage {
  Spacetime spacetime;              // of the show
  M33d axes;                        // of the reference tetrad on the sky, where the segment begins
  double duration_s = 1;            // of the segment
  const Segment* before = nullptr;  // null for the first segment
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

// ---- the part of a trajectory that a segment shows ----

inline constexpr double kNearest = 1e-6, kFarthest = 1e9;  // the radii of shows, units of M

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

// ---- trajectories of all types; each reader returns nothing for one that is in error ----

struct TimedTrajectory {
  Trajectory trajectory;
  Timing timing;
  Placement placement;
};

// Returns the types of trajectory that a body can follow there by itself.  The others need a segment,
// or an engine.
std::vector<std::string_view> trajectories_of_bodies(const Spacetime& spacetime);

// Returns the r at which an observer can rest outside of a hole, and those of free circular orbits, as
// far as one range tells.
Range resting_radii(const Stage& stage);
Range circling_radii(const Stage& stage);
// Reads the r of an observer at rest, which inside an inner horizon is possible again.  `outside` has
// those outside.
std::optional<double> read_resting_radius(const Section& s, const Stage& stage,
                                          std::string_view key, const Range& outside);

// Reports a trajectory that turns nearer to the singularity than shows may be.  Returns true for
// others.
bool turns_within_shows(const Item& item, const TimedTrajectory& read);

// Reads `region`, which is I or III, and says whether it is III.  Both have the same orbits.
bool is_in_region_three(const Section& s);

// Reads a trajectory of any type, or reports an error and returns nothing.
std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup);

// Trajectories of free fall other than the circle and the radial fall from rest at infinity.
std::optional<TimedTrajectory> read_parabolic(const Item& item, const Stage& stage, Lookup& lookup);
std::optional<TimedTrajectory> read_hyperbolic(const Item& item, const Stage& stage,
                                               Lookup& lookup);
std::optional<TimedTrajectory> read_bound(const Item& item, const Stage& stage, Lookup& lookup);
// Reads falls from rest at a finite radius, with a speed at infinity, or with angular momentum.
std::optional<TimedTrajectory> read_curved_infall(const Item& item, const Stage& stage,
                                                  Lookup& lookup);
std::optional<TimedTrajectory> read_thrown(const Item& item, const Stage& stage, Lookup& lookup);
std::optional<TimedTrajectory> read_kruskal(const Item& item, const Stage& stage, Lookup& lookup);

// The same in a wormhole.
std::optional<TimedTrajectory> read_wormhole_rest(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_wormhole_circle(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_wormhole_fall(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_wormhole_throw(const Item& item, const Stage& stage,
                                                   Lookup& lookup);
std::optional<TimedTrajectory> read_wormhole_path(const Item& item, const Stage& stage,
                                                  Lookup& lookup);
std::optional<TimedTrajectory> read_wormhole_velocity(const Item& item, const Stage& stage,
                                                      Lookup& lookup);

// The same about a hole that spins.
std::optional<TimedTrajectory> read_spin_rest(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_spin_circle(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_spin_fall(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_spin_bound(const Item& item, const Stage& stage, Lookup&);
std::optional<TimedTrajectory> read_spin_throw(const Item& item, const Stage& stage,
                                               Lookup& lookup);
std::optional<TimedTrajectory> read_spin_path(const Item& item, const Stage& stage, Lookup& lookup);
std::optional<TimedTrajectory> read_spin_velocity(const Item& item, const Stage& stage,
                                                  Lookup& lookup);

// Returns a circle in its segment, with as many orbits as the rate makes.
std::optional<TimedTrajectory> paced_circle(const Item& item, const Section& s, const Stage& stage,
                                            const Trajectory& circle, double period,
                                            const Rate& rate, bool mirrored);

// Reads flights whose engines bring them from a circular orbit into a fall, and to a stop.
std::optional<TimedTrajectory> read_spiral(const Item& item, const Stage& stage, Lookup& lookup);
std::optional<TimedTrajectory> read_braked(const Item& item, const Stage& stage, Lookup& lookup);

// What the keyframes of a path say, or the rows of its CSV file.
struct PathTable {
  const Item* item = nullptr;  // the list, or the file's name
  std::vector<PathKey> keys;
  Tetrad tetrad = Tetrad::kRain;
};
using ReadPathKey = std::optional<PathKey>(const Item& keyframe, const Stage& stage,
                                           Lookup& lookup);
// Reads `keyframes`, with the keys `keyframe`, by `read`, or `file`.  Returns nothing for an error.
std::optional<PathTable> read_path_table(const Section& s, const Stage& stage, Lookup& lookup,
                                         ReadPathKey* read, std::string_view keyframe);
// Returns the path that `make` makes of a table, or reports why it cannot be flown.
template <class Make>
std::optional<TimedTrajectory> flown(const std::optional<PathTable>& table, const Make& make) {
  if (!table) return std::nullopt;
  try {
    return make(*table);
  } catch (const std::domain_error& error) {
    return table->item->fail(std::string("cannot be flown: ") + error.what());
  }
}
std::optional<TimedTrajectory> read_path(const Item& item, const Stage& stage, Lookup& lookup);

// ---- velocities: how fast, where to, and against which observer ----

// Reads the observer near a hole against whom a velocity is given, from `against`, `region` and a
// radius.
std::optional<GivenVelocity> read_frame(const Section& s, const Stage& stage,
                                        std::string_view radius_key = "r");

// Reads gamma v against the observer `frame`, along the axes of frame.tetrad, from `speed` or
// `lorentz_factor` and `direction`.  A direction that is a place on the sky is the one in which
// that observer sees its primary image, so that the place lies dead ahead.
std::optional<Celerity<GivenFrame>> read_own_celerity(const Section& s, const Stage& stage,
                                                      const GivenVelocity& frame, Lookup& lookup);

// Reads the same of a keyframe of a path, which lies in its plane.  Returns nothing where none is
// given, or for an error.
std::optional<Celerity<GivenFrame>> read_speed_on_path(const Section& s, const Stage& stage,
                                                       const GivenVelocity& frame, Lookup& lookup);

// Returns the placement of an orbit that sets out with this celerity, which may leave the plane of
// the orbit before.
Placement placement_of(const V3d& celerity, bool mirrored);

// Reads a trajectory that holds such a velocity, or one that goes evenly in rapidity from one speed
// to another within the segment.
std::optional<Trajectory> read_velocity_trajectory(const Section& s, const Stage& stage,
                                                   const GivenVelocity& frame, Lookup& lookup);

}  // namespace domefall
