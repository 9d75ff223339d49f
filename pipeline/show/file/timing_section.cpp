#include <fmt/format.h>

#include <cmath>

#include "pipeline/show/file/trajectory_section.h"

namespace domefall {
namespace {

std::string leg_name(Leg leg) { return leg == Leg::kInward ? "inward" : "outward"; }

// Reads the leg on which a radius lies, which must be given too.
std::optional<Leg> read_leg(const Section& s, std::string_view key, std::string_view radius) {
  const Item* item = s.find(key);
  if (!item) return std::nullopt;
  if (!s.find(radius))
    return item->fail("says on which leg " + std::string(radius) + " lies; give that too");
  return s.given_word(key, {Leg::kInward, Leg::kOutward});
}

// Reports a radius that the trajectory does not pass, with the range of those that it does.
void fail_unreached(const Item& item, const Trajectory& trajectory, std::optional<Leg> leg,
                    const char* when) {
  const auto [low, high] = reach(trajectory);
  std::string range = fmt::format("it stays at r = {} M", short_number(low));
  if (low < high)
    range = fmt::format("it moves between r = {} M and {}", short_number(low),
                        short_number(high) + (std::isinf(high) ? "" : " M"));
  item.fail(fmt::format("is not passed {}{}; {}",
                        leg ? fmt::format("on the {} leg ", leg_name(*leg)) : "", when, range));
}

// Returns the unit of lengths and proper times.
const char* unit_in(const Stage& stage) {
  return stage.spacetime.is<Wormhole>() ? "radii of the throat" : "M";
}

// Says what is wrong with an instant at which the trajectory is nearer or farther than shows may
// be.
std::optional<std::string> leaves_shows(const Stage& stage, const Trajectory& trajectory,
                                        const ProperTime& tau) {
  // The r of an instant that was sought for one of the bounds themselves comes back rounded.
  constexpr double kRounding = 1e-9;
  const double r = point_at(trajectory, tau).r;
  if (r >= kNearest * (1 - kRounding) && r <= kFarthest * (1 + kRounding)) return std::nullopt;
  return fmt::format("leads to r = {} {unit}; shows go from {} to {} {unit}", short_number(r),
                     short_number(kNearest), short_number(kFarthest),
                     fmt::arg("unit", unit_in(stage)));
}

std::optional<ProperTime> read_begin_time(const Section& s, const Stage& stage,
                                          const Trajectory& trajectory) {
  const auto tau = s.given("from_tau_m");
  if (!tau) return std::nullopt;
  const Item& item = *s.find("from_tau_m");
  // Both ends are excluded, since a trajectory has no point at the singularity.
  if (!(*tau > birth(trajectory) && *tau < lifetime(trajectory)))
    return item.fail(fmt::format(
        "must lie within the trajectory, that is between {} and {} (units of M), got {}",
        short_number(birth(trajectory)), short_number(lifetime(trajectory)), as_written(item)));
  if (const auto what = leaves_shows(stage, trajectory, *tau)) return item.fail(*what);
  return *tau;
}

std::optional<ProperTime> read_begin(const Section& s, const Stage& stage,
                                     const Trajectory& trajectory, const Defaults& start) {
  const Item* given = s.one_of({"from_r", "from_tau_m"});
  const auto leg = read_leg(s, "from_leg", "from_r");
  if (s.find("from_tau_m")) return read_begin_time(s, stage, trajectory);
  if (!given) {
    if (!start.tau) s.require("from_r", " (units of M): where it begins");
    return start.tau;
  }
  const auto r = s.given("from_r");
  if (!r) return std::nullopt;
  // Where r is passed many times, as on a bound orbit, Defaults::after says which passage begins
  // the segment.
  const auto tau = time_at(trajectory, *r, leg.value_or(start.leg), start.after);
  if (!tau) fail_unreached(*given, trajectory, leg.value_or(start.leg), "by this trajectory");
  return tau;
}

// Says whether a passage of r is the beginning itself, which rounding of r has moved.  In that case
// r is the same halfway between the two.
bool is_same_passage(const Trajectory& trajectory, double r, const ProperTime& begin,
                     const ProperTime& passed) {
  constexpr double kSameRadius = 1e-12, kSoon = 1e-3;  // of r
  const auto is_there = [&](const ProperTime& tau) {
    return std::abs(point_at(trajectory, tau).r - r) <= kSameRadius * r;
  };
  const double later = double(passed - begin);
  return later < kSoon * r && is_there(begin) && is_there(begin + later / 2);
}

// Returns the proper time of the first passage of r after the beginning, on one leg or on either.
std::optional<ProperTime> passage(const Trajectory& trajectory, double r, std::optional<Leg> leg,
                                  const ProperTime& begin) {
  constexpr double kRounding = 1e-12;  // of proper time
  std::optional<ProperTime> first;
  for (const Leg each : {Leg::kInward, Leg::kOutward}) {
    if (leg && *leg != each) continue;
    auto tau = time_at(trajectory, r, each, begin);
    if (tau && is_same_passage(trajectory, r, begin, *tau))
      tau = time_at(trajectory, r, each, *tau + kRounding * (1 + std::abs(double(begin))));
    if (tau && (!first || *tau < *first)) first = tau;
  }
  return first;
}

std::optional<ProperTime> read_passage(const Section& s, const Trajectory& trajectory,
                                       const ProperTime& begin) {
  const auto leg = read_leg(s, "to_leg", "to_r");
  const auto r = s.given("to_r");
  if (!r) return std::nullopt;
  const auto tau = passage(trajectory, *r, leg, begin);
  if (!tau) fail_unreached(*s.find("to_r"), trajectory, leg, "after the segment's beginning");
  return tau;
}

// Reads an l of a wormhole, which the trajectory must pass after its beginning.
std::optional<ProperTime> read_passage_of_l(const Section& s, const Trajectory& trajectory,
                                            const ProperTime& begin) {
  constexpr double kAtOnce = 1e-12;  // of proper time: the beginning itself, rounded
  const auto l = s.given("to_l");
  if (!l) return std::nullopt;
  const auto tau = time_at_l(trajectory, *l, begin + kAtOnce * (1 + std::abs(double(begin))));
  if (!tau)
    s.find("to_l")->fail(
        "is not passed after the segment's beginning; a free fall comes through the throat with an "
        "impact parameter below 1 only, and otherwise turns where r is that");
  return tau;
}

std::optional<ProperTime> read_end_time(const Section& s, const Trajectory& trajectory,
                                        const ProperTime& begin) {
  const auto tau = s.given("to_tau_m");
  if (!tau) return std::nullopt;
  // An end at the beginning itself is allowed: time then stands still.
  if (*tau >= begin && *tau < lifetime(trajectory)) return tau;
  const Item& item = *s.find("to_tau_m");
  const double end = lifetime(trajectory);
  return item.fail(
      fmt::format("must be at least {}, where the segment begins{} (units of M), got {}",
                  short_number(double(begin)),
                  std::isinf(end) ? "," : ", and below " + short_number(end), as_written(item)));
}

// Reads the rate of a segment that has no other end.  The segment must not outlast the trajectory.
std::optional<Timing> read_rated(const Section& s, const Stage& stage, const Trajectory& trajectory,
                                 const ProperTime& begin) {
  const auto rate = read_rate(s, stage);
  if (!rate) return std::nullopt;
  // The sum has two doubles, so that a short segment late in a long trajectory keeps its length.
  const ProperTime end = begin + rate->span;
  if (end < lifetime(trajectory)) return Timing{begin, end, Pace::kSteady, rate->begin, rate->end};
  const Item* given = s.one_of({"rate_m_per_s", "time_lapse"});
  const std::string what = fmt::format(
      "lets {} {unit} of proper time pass in the segment, but the trajectory ends {} {unit} after "
      "its beginning",
      short_number(rate->span), short_number(double(lifetime(trajectory) - begin)),
      fmt::arg("unit", unit_in(stage)));
  if (given)
    given->fail(what + "; slow it down, shorten duration_s or give to_r");
  else
    s.require("to_r", ": the default rate of 1 M per second " + what);
  return std::nullopt;
}

bool check_end(const Section& s, const Stage& stage, const Trajectory& trajectory,
               const ProperTime& tau) {
  const auto what = leaves_shows(stage, trajectory, tau);
  if (!what) return true;
  const Item* given = nullptr;
  // The last of these keys that is given decided the end, since to_r and to_tau_m take precedence.
  for (const char* key : {"time_lapse", "rate_m_per_s", "to_tau_m", "to_l", "to_r"})
    if (const Item* item = s.find(key)) given = item;
  if (given)
    given->fail(*what);
  else
    s.require("to_r", ": the default rate of 1 M per second " + *what);
  return false;
}

}  // namespace

std::optional<Timing> read_end(const Section& s, const Stage& stage, const Trajectory& trajectory,
                               const ProperTime& begin, const Defaults& defaults) {
  const Item* given = find_end(s, {"to_r", "to_l", "to_tau_m"});
  Timing timing{begin, begin};
  const Item* pace = s.find("pace");
  if (pace && is_word(*pace, "frozen")) {
    if (!read_pace(s, trajectory, timing)) return std::nullopt;
    return timing;
  }
  std::optional<ProperTime> end;
  if (!s.find("to_r")) read_leg(s, "to_leg", "to_r");
  if (s.find("to_r")) {
    end = read_passage(s, trajectory, begin);
    if (!end) return std::nullopt;
  } else if (s.find("to_l")) {
    end = read_passage_of_l(s, trajectory, begin);
    if (!end) return std::nullopt;
  } else if (s.find("to_tau_m")) {
    end = read_end_time(s, trajectory, begin);
    if (!end) return std::nullopt;
  } else if (!given && defaults.to_r) {
    // A default end that is never passed leaves the end to the default rate.
    end = passage(trajectory, *defaults.to_r, std::nullopt, begin);
  } else if (!given) {
    end = defaults.to_tau;
  }
  if (end) {
    timing.tau_end = *end;
    if (!read_end_rates(s, stage, timing)) return std::nullopt;
  } else {
    const auto rated = read_rated(s, stage, trajectory, begin);
    if (!rated) return std::nullopt;
    timing = *rated;
  }
  if (!check_end(s, stage, trajectory, timing.tau_end)) return std::nullopt;
  if (!read_pace(s, trajectory, timing)) return std::nullopt;
  return timing;
}

std::optional<Timing> read_timing(const Section& s, const Stage& stage,
                                  const Trajectory& trajectory, const Defaults& defaults) {
  const auto begin = read_begin(s, stage, trajectory, defaults);
  return begin ? read_end(s, stage, trajectory, *begin, defaults) : std::nullopt;
}

}  // namespace domefall
