#include "pipeline/show/timing_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace domefall {
namespace {

constexpr double kMostRate = 1e12;
constexpr double kDefaultRate = 1;  // M per second
constexpr Range kRateRange = Range{"units of M per second of show"}.within(0, kMostRate);
// Proper times are read as doubles, which are 0.125 M apart at 1e15 M.
constexpr Range kClock = kUnitsOfM.within(-1e15, 1e15);

// Returns the word of a leg, as show files have it.
std::string leg_name(Leg leg) { return leg == Leg::kInward ? "inward" : "outward"; }

// Reads the leg on which a radius lies, which must be given too.
std::optional<Leg> read_leg(const Section& s, std::string_view key, std::string_view radius) {
  const Item* item = s.find(key);
  if (!item) return std::nullopt;
  if (!s.find(radius)) {
    item->fail("says on which leg " + std::string(radius) + " lies; give that too");
    return std::nullopt;
  }
  return s.word<Leg>(key, {{"inward", Leg::kInward}, {"outward", Leg::kOutward}});
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

// Says what is wrong with an instant at which the trajectory is nearer or farther than shows may
// be.
std::optional<std::string> leaves_shows(const Trajectory& trajectory, const ProperTime& tau) {
  // The r of an instant that was sought for one of the bounds themselves comes back rounded.
  constexpr double kRounding = 1e-9;
  const double r = point_at(trajectory, tau).r;
  if (r >= kNearest * (1 - kRounding) && r <= kFarthest * (1 + kRounding)) return std::nullopt;
  return fmt::format("leads to r = {} M; shows go from {} to {} M", short_number(r),
                     short_number(kNearest), short_number(kFarthest));
}

// Reads from_tau_m, which must lie within the trajectory.
std::optional<ProperTime> read_begin_time(const Section& s, const Trajectory& trajectory) {
  const auto tau = s.number("from_tau_m", kClock);
  if (!tau) return std::nullopt;
  const Item& item = *s.find("from_tau_m");
  // Both ends are excluded, since a trajectory has no point at the singularity.
  if (!(*tau > birth(trajectory) && *tau < lifetime(trajectory))) {
    item.fail(fmt::format(
        "must lie within the trajectory, that is between {} and {} (units of M), got {}",
        short_number(birth(trajectory)), short_number(lifetime(trajectory)), as_written(item)));
    return std::nullopt;
  }
  if (const auto what = leaves_shows(trajectory, *tau)) {
    item.fail(*what);
    return std::nullopt;
  }
  return *tau;
}

// Reads where the segment begins, which may have a default.
std::optional<ProperTime> read_begin(const Section& s, const Trajectory& trajectory,
                                     const Defaults& start) {
  const Item* given = s.one_of({"from_r", "from_tau_m"});
  const auto leg = read_leg(s, "from_leg", "from_r");
  if (s.find("from_tau_m")) return read_begin_time(s, trajectory);
  if (!given) {
    if (!start.tau) s.require("from_r", " (units of M): where it begins");
    return start.tau;
  }
  const auto r = s.number("from_r", kRadius);
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
  // An orbit passes r on either leg, and the earlier passage counts.
  std::optional<ProperTime> first;
  for (const Leg each : {Leg::kInward, Leg::kOutward}) {
    if (leg && *leg != each) continue;
    auto tau = time_at(trajectory, r, each, begin);
    // The search goes on just behind the passage that is the beginning itself.
    if (tau && is_same_passage(trajectory, r, begin, *tau))
      tau = time_at(trajectory, r, each, *tau + kRounding * (1 + std::abs(double(begin))));
    if (tau && (!first || *tau < *first)) first = tau;
  }
  return first;
}

// Reads to_r: the segment ends where r is passed for the first time after its beginning.
std::optional<ProperTime> read_passage(const Section& s, const Trajectory& trajectory,
                                       const ProperTime& begin) {
  const auto leg = read_leg(s, "to_leg", "to_r");
  const auto r = s.number("to_r", kRadius);
  if (!r) return std::nullopt;
  const auto tau = passage(trajectory, *r, leg, begin);
  if (!tau) fail_unreached(*s.find("to_r"), trajectory, leg, "after the segment's beginning");
  return tau;
}

// Reads to_tau_m, which must lie within the trajectory and not before the segment's beginning.
std::optional<ProperTime> read_end_time(const Section& s, const Trajectory& trajectory,
                                        const ProperTime& begin) {
  const auto tau = s.number("to_tau_m", kClock);
  if (!tau) return std::nullopt;
  // An end at the beginning itself is allowed: time then stands still.
  if (*tau >= begin && *tau < lifetime(trajectory)) return tau;
  const Item& item = *s.find("to_tau_m");
  const double end = lifetime(trajectory);
  item.fail(fmt::format("must be at least {}, where the segment begins{} (units of M), got {}",
                        short_number(double(begin)),
                        std::isinf(end) ? "," : ", and below " + short_number(end),
                        as_written(item)));
  return std::nullopt;
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
      "lets {} M of proper time pass in the segment, but the trajectory ends {} M after its "
      "beginning",
      short_number(rate->span), short_number(double(lifetime(trajectory) - begin)));
  if (given)
    given->fail(what + "; slow it down, shorten duration_s or give to_r");
  else
    s.require("to_r", ": the default rate of 1 M per second " + what);
  return std::nullopt;
}

// Returns true if the end lies within the radii that shows may have, and reports one that does not.
bool check_end(const Section& s, const Trajectory& trajectory, const ProperTime& tau) {
  const auto what = leaves_shows(trajectory, tau);
  if (!what) return true;
  const Item* given = nullptr;
  // The last of these keys that is given decided the end, since to_r and to_tau_m take precedence.
  for (const char* key : {"time_lapse", "rate_m_per_s", "to_tau_m", "to_r"})
    if (const Item* item = s.find(key)) given = item;
  if (given)
    given->fail(*what);
  else
    s.require("to_r", ": the default rate of 1 M per second " + *what);
  return false;
}

// Says whether `rate_m_per_s` is a list, which gives the rates at both ends.
bool has_two_rates(const Section& s) {
  const Item* rate = s.find("rate_m_per_s");
  return rate && rate->node.IsSequence();
}

// Says whether r only falls or only rises between two instants, so that each r has one time.
bool goes_one_way(const Trajectory& trajectory, const Timing& timing) {
  const ProperTime &from = timing.tau_begin, &to = timing.tau_end;
  const double span = double(to - from), end = point_at(trajectory, to).r;
  double r = point_at(trajectory, from).r;
  const bool inward = end < r;
  // The samples stand evenly, and close behind the beginning, which may be next to a turning point.
  constexpr double kSoon[] = {1e-6, 1e-3};
  constexpr int kSamples = 64;
  const auto goes_on = [&](double part) {
    const double before = std::exchange(r, point_at(trajectory, from + span * part).r);
    return inward ? r < before : r > before;
  };
  for (const double part : kSoon)
    if (!goes_on(part)) return false;
  for (int k = 1; k <= kSamples; ++k)
    if (!goes_on(static_cast<double>(k) / kSamples)) return false;
  // A turn between two samples would make the end a later passage than the first.
  const auto first = time_at(trajectory, end, inward ? Leg::kInward : Leg::kOutward, from);
  constexpr double kRounding = 1e-6;
  return !first || double(to - *first) < kRounding * span;
}

// These are the words of `pace`.
enum class Word {
  kSteady,
  kEased,
  kEasedIn,
  kEasedOut,
  kSlowing,
  kQuickening,
  kLogRadius,
  kFrozen
};

// Returns the word of `pace`, or nothing where the key is missing or its word is not known.
std::optional<Word> read_word(const Section& s) {
  return s.word<Word>("pace", {{"steady", Word::kSteady},
                               {"eased", Word::kEased},
                               {"eased_in", Word::kEasedIn},
                               {"eased_out", Word::kEasedOut},
                               {"slowing", Word::kSlowing},
                               {"quickening", Word::kQuickening},
                               {"log_r", Word::kLogRadius},
                               {"frozen", Word::kFrozen}});
}

}  // namespace

// One M of a hole lasts kSecondsPerSolarMass for each solar mass.  Flat space has no M, and its
// proper times stay in seconds.
double proper_time_in(const Stage& stage, double seconds) {
  return stage.mass_solar ? seconds / (*stage.mass_solar * kSecondsPerSolarMass) : seconds;
}

std::optional<Rate> read_rate(const Section& s, const Stage& stage, std::optional<double> period) {
  if (s.find("time_lapse")) {
    const auto lapse =
        s.number("time_lapse", Range{"real seconds per second of show"}.within(0, kMostRate));
    if (!lapse) return std::nullopt;
    return Rate{proper_time_in(stage, *lapse * stage.duration_s)};
  }
  // Without a period the radius is in error, which has been reported.
  if (s.find("orbits")) {
    const auto orbits = s.number("orbits", Range{"revolutions"}.within(0, kMostOrbits));
    if (!orbits || !period) return std::nullopt;
    return Rate{*orbits * *period};
  }
  const Item* rate = s.find("rate_m_per_s");
  if (!rate) return Rate{kDefaultRate * stage.duration_s};
  if (rate->node.IsSequence()) {
    const auto ends = read_numbers(*rate, 2, kRateRange);
    if (!ends) return std::nullopt;
    // Over their mean the two rates add up to 2, so that part_passed() ramps smoothly between them.
    const double mean = ((*ends)[0] + (*ends)[1]) / 2;
    // With two rates of 0 time stands still, and no rate is a part of a mean of 0.
    if (!(mean > 0)) return Rate{0};
    return Rate{mean * stage.duration_s, (*ends)[0] / mean, (*ends)[1] / mean};
  }
  const auto value = read_number(*rate, kRateRange);
  if (!value) return std::nullopt;
  return Rate{*value * stage.duration_s};
}

const Item* find_end(const Section& s, std::initializer_list<std::string_view> ends) {
  const Item* end = s.one_of(ends);
  if (!end) return s.one_of({"rate_m_per_s", "time_lapse"});
  const std::string key = end->path.substr(end->path.rfind('.') + 1);
  for (const char* rate : {"rate_m_per_s", "time_lapse"}) {
    // A single rate would say a second time where the segment ends, while two rates only say how it
    // gets there.
    const Item* item = s.find(rate);
    if (!item || item->node.IsSequence()) continue;
    item->fail("excludes " + key + "; give one of them");
  }
  return end;
}

bool read_end_rates(const Section& s, const Stage& stage, Timing& timing) {
  if (!has_two_rates(s)) return true;
  const Item& item = *s.find("rate_m_per_s");
  const auto ends = read_numbers(item, 2, kRateRange);
  if (!ends) return false;
  // The fixed ends give the mean rate, and part_passed() bends the rate between its two ends to it.
  const double mean = double(timing.tau_end - timing.tau_begin) / stage.duration_s;
  if (!(mean > 0)) {
    item.fail("needs an end behind the segment's beginning");
    return false;
  }
  timing.rate_begin = (*ends)[0] / mean, timing.rate_end = (*ends)[1] / mean;
  return true;
}

bool read_pace(const Section& s, const Trajectory& trajectory, Timing& timing) {
  const Item* item = s.find("pace");
  if (!item) return true;
  const auto pace = read_word(s);
  if (!pace) return false;
  const bool ramped = has_two_rates(s);
  switch (*pace) {
    case Word::kSteady:
      return true;
    case Word::kEased:
      timing.pace = Pace::kEased;
      break;
    case Word::kEasedIn:
      // Rates of 0 and 2 have the mean 1, so that the rate rises steadily (rate_law.h).
      timing.rate_begin = 0, timing.rate_end = 2;
      break;
    case Word::kEasedOut:
      // This is the same run backwards.
      timing.rate_begin = 2, timing.rate_end = 0;
      break;
    case Word::kSlowing:
    case Word::kQuickening: {
      const bool slowing = *pace == Word::kSlowing;
      timing.pace = slowing ? Pace::kSlowing : Pace::kQuickening;
      // A path has a finite life too, but it ends at its last key.  Only what reaches r = 0 ends,
      // or begins, in a singularity.
      const bool singular = reach(trajectory).first == 0;
      if (singular && std::isfinite(slowing ? lifetime(trajectory) : birth(trajectory))) break;
      item->fail(slowing
                     ? "of 'slowing' needs a trajectory that ends in the singularity"
                     : "of 'quickening' needs a trajectory that begins in the past singularity");
      return false;
    }
    case Word::kLogRadius:
      timing.pace = Pace::kLogRadius;
      if (goes_one_way(trajectory, timing)) break;
      item->fail(
          "of 'log_r' needs an r that only falls or only rises in the segment; end it, or begin "
          "it, where the orbit turns");
      return false;
    case Word::kFrozen:
      timing.tau_end = timing.tau_begin;
      for (const char* key : {"to_r", "to_tau_m", "rate_m_per_s", "time_lapse", "orbits"})
        if (const Item* other = s.find(key)) {
          other->fail("is for time that passes; the pace is frozen");
          return false;
        }
      return true;
  }
  // A steady pace goes with two rates, and a frozen one has returned.  All others shape the rate.
  if (!ramped) return true;
  item->fail("excludes two rates, which shape the pace themselves; give one of them");
  return false;
}

std::optional<Timing> read_end(const Section& s, const Stage& stage, const Trajectory& trajectory,
                               const ProperTime& begin, const Defaults& defaults) {
  // A key that excludes another is reported here, before any of them is read.
  const Item* given = find_end(s, {"to_r", "to_tau_m"});
  Timing timing{begin, begin};
  const Item* pace = s.find("pace");
  // A frozen segment ends at the instant at which it begins.
  if (pace && is_word(*pace, "frozen")) {
    if (!read_pace(s, trajectory, timing)) return std::nullopt;
    return timing;
  }
  std::optional<ProperTime> end;
  // A leg without a radius is reported.
  if (!s.find("to_r")) read_leg(s, "to_leg", "to_r");
  if (s.find("to_r")) {
    end = read_passage(s, trajectory, begin);
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
  if (!check_end(s, trajectory, timing.tau_end)) return std::nullopt;
  if (!read_pace(s, trajectory, timing)) return std::nullopt;
  return timing;
}

std::optional<Timing> read_timing(const Section& s, const Stage& stage,
                                  const Trajectory& trajectory, const Defaults& defaults) {
  const auto begin = read_begin(s, trajectory, defaults);
  return begin ? read_end(s, stage, trajectory, *begin, defaults) : std::nullopt;
}

}  // namespace domefall
