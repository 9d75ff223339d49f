#include <cmath>
#include <string>
#include <utility>

#include "pipeline/show/file/trajectory_section.h"

namespace domefall {
namespace {

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

}  // namespace

double proper_time_in(const Stage& stage, double seconds) {
  return seconds / stage.spacetime.seconds_per_m();
}

std::optional<Rate> read_rate(const Section& s, const Stage& stage, std::optional<double> period) {
  if (s.find("time_lapse")) {
    const auto lapse = s.given("time_lapse");
    if (!lapse) return std::nullopt;
    return Rate{proper_time_in(stage, *lapse * stage.duration_s)};
  }
  if (s.find("orbits")) {
    const auto orbits = s.given("orbits");
    if (!orbits || !period) return std::nullopt;
    return Rate{*orbits * *period};
  }
  const Item* rate = s.find("rate_m_per_s");
  if (!rate) return Rate{s.number("rate_m_per_s") * stage.duration_s};
  if (rate->node.IsSequence()) {
    const auto ends = read_numbers(*rate, 2, s.range("rate_m_per_s"));
    if (!ends) return std::nullopt;
    // Over their mean the two rates add up to 2, so that part_passed() ramps smoothly between them.
    const double mean = ((*ends)[0] + (*ends)[1]) / 2;
    // With two rates of 0 time stands still, and no rate is a part of a mean of 0.
    if (!(mean > 0)) return Rate{0};
    return Rate{mean * stage.duration_s, (*ends)[0] / mean, (*ends)[1] / mean};
  }
  const auto value = read_number(*rate, s.range("rate_m_per_s"));
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
  const auto ends = read_numbers(item, 2, s.range("rate_m_per_s"));
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
  using enum Word;
  const auto pace = s.given_word(
      "pace", {kSteady, kEased, kEasedIn, kEasedOut, kSlowing, kQuickening, kLogRadius, kFrozen});
  if (!pace) return false;
  const bool ramped = has_two_rates(s);
  switch (*pace) {
    case kSteady:
      return true;
    case kEased:
      timing.pace = Pace::kEased;
      break;
    case kEasedIn:
      // Rates of 0 and 2 have the mean 1, so that the rate rises steadily (curve.h).
      timing.rate_begin = 0, timing.rate_end = 2;
      break;
    case kEasedOut:
      timing.rate_begin = 2, timing.rate_end = 0;
      break;
    case kSlowing:
    case kQuickening: {
      const bool slowing = *pace == kSlowing;
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
    case kLogRadius:
      timing.pace = Pace::kLogRadius;
      if (goes_one_way(trajectory, timing)) break;
      item->fail(
          "of 'log_r' needs an r that only falls or only rises in the segment; end it, or begin "
          "it, where the orbit turns");
      return false;
    case kFrozen:
      timing.tau_end = timing.tau_begin;
      for (const char* key : {"to_r", "to_l", "to_tau_m", "rate_m_per_s", "time_lapse", "orbits"})
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

}  // namespace domefall
