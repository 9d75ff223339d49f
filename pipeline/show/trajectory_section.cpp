#include "pipeline/show/trajectory_section.h"

#include <algorithm>
#include <array>

#include "pipeline/show/placement.h"
#include "pipeline/show/velocity_section.h"

namespace domefall {
namespace {

constexpr double kNearest = 1e-6, kFarthest = 1e9;
constexpr double kDefaultEnd = 0.05, kDefaultRate = 1, kMostRate = 1e12;
// So that the azimuth keeps nine digits behind the point.
constexpr double kMostOrbits = 1e6;
// A fall is timed from its start.  Rounding of r^(3/2) there misplaces an end at 1e-8 of the start
// by 6e-4 of itself, at 1e-9 by 2 %, at 1e-11 it can be 0 (measured, 2e5 random falls each).
constexpr double kLongestFall = 1e8;

// How far proper time runs in the segment by the key that says it; nothing if it is in error.
std::optional<double> read_proper_time(const Section& s, const Stage& stage,
                                       std::optional<double> period) {
  const auto positive = [&](std::string_view key, std::string_view unit, double most) {
    return s.number(key, Range{unit}.within(0, most));
  };
  if (s.find("time_lapse")) {
    const auto lapse = positive("time_lapse", "real seconds per second of show", kMostRate);
    if (!lapse) return std::nullopt;
    return proper_time_in(stage, *lapse * stage.duration_s);
  }
  if (s.find("orbits")) {
    const auto orbits = positive("orbits", "revolutions", kMostOrbits);
    if (!orbits || !period) return std::nullopt;
    return *orbits * *period;
  }
  if (s.find("rate_m_per_s")) {
    const auto rate = positive("rate_m_per_s", "units of M per second of show", kMostRate);
    if (!rate) return std::nullopt;
    return *rate * stage.duration_s;
  }
  return kDefaultRate * stage.duration_s;
}

std::optional<TimedTrajectory> read_static(const Item& item, const Stage& stage) {
  const Section s(item, {"type", "r"});
  const double real_time = proper_time_in(stage, stage.duration_s);
  if (!stage.mass_solar) {
    if (const Item* r = s.find("r")) r->fail("needs a black hole; in flat space leave it out");
    return TimedTrajectory{StaticObserver{}, 0, real_time};
  }
  const auto r = s.required_number(
      "r", kUnitsOfM.above(kStaticInnermost, "nothing holds still at or inside the horizon")
               .at_most(kFarthest));
  if (!r) return std::nullopt;
  return TimedTrajectory{StaticObserver{*r}, 0, real_time};
}

std::optional<TimedTrajectory> read_circular(const Item& item, const Stage& stage) {
  const Section s(item, {"type", "r", "orbits", "rate_m_per_s", "time_lapse"});
  s.one_of({"orbits", "rate_m_per_s", "time_lapse"});
  const auto r = s.required_number(
      "r", kUnitsOfM
               .above(kCircularInnermost,
                      "at the light circle an orbit needs the speed of light, below it more")
               .at_most(kFarthest));
  const auto tau = read_proper_time(s, stage, r ? std::optional(period({*r})) : std::nullopt);
  if (!r || !tau) return std::nullopt;
  const double orbits = *tau / period({*r});
  if (orbits > kMostOrbits * (1 + 1e-9)) {  // the given number comes back rounded
    const Item* pace = s.one_of({"rate_m_per_s", "time_lapse"});
    (pace ? *pace : item)
        .fail("makes " + short_number(orbits) + " orbits in the segment; at most " +
              short_number(kMostOrbits) + " are possible");
    return std::nullopt;
  }
  return TimedTrajectory{CircularOrbit{*r}, 0, *tau};
}

// The end of a fall that is timed by a rate; it must come before the singularity.
std::optional<double> read_fall_time(const Section& s, const Stage& stage,
                                     const RadialInfall& fall) {
  const auto tau = read_proper_time(s, stage, std::nullopt);
  const double most = proper_time_to(fall, std::max(kNearest, fall.from_r / kLongestFall));
  if (!tau || *tau <= most) return tau;
  s.one_of({"rate_m_per_s", "time_lapse"})
      ->fail("lets " + short_number(*tau) + " M of proper time pass in the segment, but from r = " +
             short_number(fall.from_r) + " the singularity is " + short_number(lifetime(fall)) +
             " M away; slow it down, shorten duration_s or give to_r");
  return std::nullopt;
}

std::optional<TimedTrajectory> read_infall(const Item& item, const Stage& stage) {
  const Section s(item, {"type", "from_r", "to_r", "pace", "rate_m_per_s", "time_lapse"});
  const Item* timing = s.one_of({"to_r", "rate_m_per_s", "time_lapse"});
  const Item* to = s.find("to_r");
  const auto to_r = s.number("to_r", kUnitsOfM.at_least(kNearest).at_most(kFarthest));
  const auto from_r = s.required_number("from_r", kUnitsOfM.above(0).at_most(kFarthest));
  if (!from_r || (to && !to_r)) return std::nullopt;
  const RadialInfall fall{*from_r};
  const bool slowing = s.choice("pace", {"steady", "slowing"}).value_or(0) == 1;
  if (timing && !to) {
    if (slowing) s.find("pace")->fail("of 'slowing' needs to_r, not a rate");
    const auto tau = read_fall_time(s, stage, fall);
    return tau ? std::optional(TimedTrajectory{fall, 0, *tau}) : std::nullopt;
  }
  const double end = to_r.value_or(kDefaultEnd);
  if (end >= *from_r) {
    (to ? to : s.find("from_r"))
        ->fail(to ? "must stay below from_r = " + short_number(*from_r) + " (units of M), got " +
                        short_number(end) + ": a free fall only goes inward"
                  : "must exceed " + short_number(end) +
                        " (units of M), the default of to_r, got " + short_number(*from_r) +
                        ": a free fall only goes inward");
    return std::nullopt;
  }
  if (end * kLongestFall < *from_r) {
    (to ? to : s.find("from_r"))
        ->fail(std::string(to ? "" : "needs to_r, whose default 0.05 is too deep: to_r ") +
               "must be at least from_r / 1e8 = " + short_number(*from_r / kLongestFall) +
               " (units of M), got " + short_number(end) + "; fall on in a further segment");
    return std::nullopt;
  }
  return TimedTrajectory{fall, 0, proper_time_to(fall, end),
                         slowing ? Pace::kSlowing : Pace::kSteady};
}

std::optional<TimedTrajectory> read_velocity(const Item& item, const Stage& stage, Lookup& lookup) {
  const Section s(item, {"type", "r", "region", "speed", "lorentz_factor", "against", "direction"});
  GivenVelocity observer;
  if (stage.mass_solar) {
    const auto frame = read_frame(s);
    if (!frame) return std::nullopt;
    observer = *frame;
  } else {
    for (const char* key : {"r", "region"})
      if (const Item* given = s.find(key))
        given->fail("needs a black hole; in flat space leave it out");
  }
  const auto celerity = read_celerity(s, stage, observer, lookup);
  if (!celerity) return std::nullopt;
  observer.celerity = *celerity;
  return TimedTrajectory{observer, 0, proper_time_in(stage, stage.duration_s)};
}

}  // namespace

double proper_time_in(const Stage& stage, double seconds) {
  return stage.mass_solar ? seconds / (*stage.mass_solar * kSecondsPerSolarMass) : seconds;
}

std::optional<TimedTrajectory> read_trajectory(const Item& item, const Stage& stage,
                                               Lookup& lookup) {
  static constexpr std::array<std::string_view, 4> kTypes{"static", "circular", "infall",
                                                          "velocity"};
  const auto type = peek(item, "type");
  if (!type) {
    const Section any(
        item, {"type", "r", "from_r", "to_r", "pace", "rate_m_per_s", "time_lapse", "orbits",
               "speed", "lorentz_factor", "against", "direction", "region"});
    any.require("type", ": static, circular, infall or velocity");
    return std::nullopt;
  }
  const auto kind = read_choice(*type, kTypes);
  if (!kind) return std::nullopt;
  if (!stage.mass_solar && (*kind == 1 || *kind == 2)) {
    type->fail("'" + type->node.Scalar() +
               "' needs a black hole: give the show black_hole.mass_solar");
    return std::nullopt;
  }
  if (*kind == 0) return read_static(item, stage);
  if (*kind == 1) return read_circular(item, stage);
  if (*kind == 2) return read_infall(item, stage);
  return read_velocity(item, stage, lookup);
}

}  // namespace domefall
