#include "pipeline/show/show_event.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

constexpr int kHalvings = 60;

// A Way is how far from the hole a segment's observer is when a part of it has passed.
class Way {
 public:
  Way(const Show& show, int segment) : show_(show), segment_(segment) {}

  double r(double part) const { return observer_at(show_, segment_, part).r; }

  // Returns the part at which r is a value that it passes between two others.
  double crossing(double from, double to, double value) const {
    const bool falls = r(from) > value;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = std::midpoint(from, to);
      ((r(middle) > value) == falls ? from : to) = middle;
    }
    return to;
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
  const Show& show_;
  int segment_;
};

// Returns the part of a segment that has passed when the observer is at r for the first time.  The
// ends of segments are where they were meant to be but for rounding.
std::optional<double> part_at_radius(double r, const Way& way, int steps) {
  constexpr double kRounding = 1e-9;
  double last = way.r(0);
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps, now = way.r(part);
    if (std::abs(now - r) <= kRounding * r) return part;
    if ((last - r) * (now - r) < 0) return way.crossing(part - 1.0 / steps, part, r);
    last = now;
  }
  return std::nullopt;
}

// Returns the part that has passed when r is least between larger ones.
std::optional<double> part_at_periastron(const Way& way, int steps) {
  double before = way.r(0), last = before;
  for (int k = 1; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps, now = way.r(part);
    if (k > 1 && before > last && last <= now) return way.lowest(part - 2.0 / steps, part);
    before = last, last = now;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> time_of(const MarkerEvent& event, const Show& show) {
  constexpr double kStepsPerFrame = 4;
  constexpr int kFewest = 64, kMost = 40'000;
  if (show.spacetime.is_flat()) return std::nullopt;
  for (int k = 0; k < static_cast<int>(show.timeline.size()); ++k) {
    const double duration = segment_of(show, k).duration_s;
    const double steps = duration * show.frames_per_second * kStepsPerFrame;
    const int count = static_cast<int>(std::clamp(steps, double{kFewest}, double{kMost}));
    const Way way(show, k);
    const auto part =
        event.r ? part_at_radius(*event.r, way, count) : part_at_periastron(way, count);
    if (part) return begin_of(show, k) + *part * duration;
  }
  return std::nullopt;
}

}  // namespace domefall
