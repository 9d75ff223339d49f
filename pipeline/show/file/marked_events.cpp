#include "pipeline/show/file/marked_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/show/file/section.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

constexpr int kHalvings = 60;
constexpr double kAtEnds = 1e-9;  // of r or l at the ends of segments, as a part of it

std::string leg_text(std::optional<Leg> leg) {
  if (!leg) return "";
  return *leg == Leg::kInward ? " on its way inward" : " on its way outward";
}

// Says whether an event is where r, or l, has some value.
bool is_at_place(const MarkerEvent& event) { return event.r || event.l; }
double place_of(const MarkerEvent& event) { return event.l ? *event.l : *event.r; }
double place_of(const MarkerEvent& event, const OrbitPoint& point) {
  return event.l ? point.l : point.r;
}
// Says whether a place is the event's but for rounding.
bool is_at(const MarkerEvent& event, double place) {
  const double wanted = place_of(event), size = event.l ? std::max(1.0, std::abs(wanted)) : wanted;
  return std::abs(place - wanted) <= kAtEnds * size;
}

bool is_to_come(const Marker& marker) { return marker.event && std::isnan(marker.at_s); }

}  // namespace

// A Way is how far from the hole a segment's observer is when a part of it has passed.
class MarkedEvents::Way {
 public:
  Way(const Segment& segment, double frames_per_second) : segment_(segment) {
    constexpr double kStepsPerFrame = 4, kFewest = 64, kMost = 40'000;
    steps_ = static_cast<int>(
        std::clamp(segment.duration_s * frames_per_second * kStepsPerFrame, kFewest, kMost));
  }

  int steps() const { return steps_; }
  double part(int step) const { return std::clamp(static_cast<double>(step) / steps_, 0.0, 1.0); }
  OrbitPoint point(double part) const {
    return point_at(segment_.trajectory, proper_time_at(segment_, part));
  }
  double r(double part) const { return point(part).r; }

  // Returns the part that has passed when the observer is at the event's place for the first time, on
  // its leg if it has one.  The ends of segments are where they were meant to be but for rounding.
  std::optional<double> at_place(const MarkerEvent& event) const {
    const auto is_meant = [leg = event.leg](double before, double after) {
      return !leg || (*leg == Leg::kInward ? after < before : after > before);
    };
    const auto at = [&](double part) { return place_of(event, point(part)); };
    const double wanted = place_of(event);
    double last = at(0);
    for (int k = 0; k <= steps_; ++k) {
      const double now = at(part(k));
      const bool there = is_at(event, now);
      if (there && (k < steps_ ? is_meant(now, at(part(k + 1))) : is_meant(last, now)))
        return part(k);
      if (!there && (last - wanted) * (now - wanted) < 0 && is_meant(last, now))
        return crossing(part(k - 1), part(k), wanted, at);
      last = now;
    }
    return std::nullopt;
  }

  // Returns the part at which r is least, where it falls and then rises.
  double lowest(double from, double to) const {
    for (int k = 0; k < kHalvings; ++k) {
      const double left = from + (to - from) / 3, right = to - (to - from) / 3;
      (r(left) < r(right) ? to : from) = r(left) < r(right) ? right : left;
    }
    return std::midpoint(from, to);
  }

 private:
  // Returns the part at which at(part) is a value that it passes between two others.
  template <class At>
  static double crossing(double from, double to, double value, const At& at) {
    const bool falls = at(from) > value;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = std::midpoint(from, to);
      ((at(middle) > value) == falls ? from : to) = middle;
    }
    return to;
  }

  const Segment& segment_;
  int steps_;
};

// Returns the part that has passed when r is least between larger ones.  It may have fallen in the
// segments before, and stood still since.
std::optional<double> MarkedEvents::part_at_periastron(const Way& way) {
  constexpr double kNoise = 1e-12;  // of r where it stays, as a part of it
  double r = way.r(0), low = r, high = r;
  falls_ = falls_ && std::abs(r - r_) <= kAtEnds * r;
  int low_at = 0;
  for (int k = 1; k <= way.steps(); ++k) {
    r = way.r(way.part(k));
    if (!falls_) {
      high = std::max(high, r);
      falls_ = r < high * (1 - kNoise);
      low = r, low_at = k;
    } else if (r <= low) {
      low = r, low_at = k;
    } else if (r > low * (1 + kNoise)) {
      return way.lowest(way.part(low_at - 1), way.part(low_at + 1));
    }
  }
  r_ = r;
  return std::nullopt;
}

void MarkedEvents::follow(const Segment& segment, double begin_s) {
  if (std::ranges::none_of(markers_, is_to_come)) return;
  const Way way(segment, frames_per_second_);
  const auto periastron = part_at_periastron(way);
  for (Marker& marker : markers_) {
    if (!is_to_come(marker)) continue;
    const auto part = is_at_place(*marker.event) ? way.at_place(*marker.event) : periastron;
    if (part) marker.at_s = begin_s + *part * segment.duration_s;
  }
}

Marker* MarkedEvents::coming(const Item& time) const {
  const auto found = std::ranges::find_if(markers_, [&](const Marker& marker) {
    return is_to_come(marker) && is_word(time, marker.name);
  });
  return found == markers_.end() ? nullptr : &*found;
}

std::optional<ProperTime> time_of_event(const MarkerEvent& event, const Trajectory& trajectory,
                                        const ProperTime& begin) {
  if (!is_at_place(event)) return next_periastron(trajectory, begin);
  // The place of a beginning that was sought for itself comes back rounded.
  if (!event.leg && is_at(event, place_of(event, point_at(trajectory, begin)))) return begin;
  if (event.l) {
    auto tau = time_at_l(trajectory, *event.l, begin);
    if (!tau || !event.leg) return tau;
    const double moment = kAtEnds * (1 + std::abs(double(*tau)));
    const bool falls = point_at(trajectory, *tau + moment).l < *event.l;
    return falls == (*event.leg == Leg::kInward) ? tau
                                                 : time_at_l(trajectory, *event.l, *tau + moment);
  }
  std::optional<ProperTime> first;
  for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
    if (event.leg && leg != *event.leg) continue;
    const auto tau = time_at(trajectory, *event.r, leg, begin);
    if (tau && (!first || *tau < *first)) first = tau;
  }
  return first;
}

void report_missing_events(const Item& list, const std::vector<Marker>& markers) {
  for (const Marker& marker : markers)
    if (is_to_come(marker))
      peek(list, marker.name)
          ->fail(is_at_place(*marker.event)
                     ? fmt::format("happens nowhere in the show, which is never at {} = {}{}",
                                   marker.event->l ? 'l' : 'r',
                                   short_number(place_of(*marker.event)),
                                   leg_text(marker.event->leg))
                     : "happens nowhere in the show, whose r never falls and rises again");
}

}  // namespace domefall
