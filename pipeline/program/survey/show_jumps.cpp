#include "pipeline/program/survey/show_jumps.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/show/attitude.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/sources/disc/disc_pattern.h"

namespace domefall {
namespace {

constexpr int kMostPairs = 20'000;
constexpr double kRadianDeg = 180 / std::numbers::pi;

// Returns the speed of two observers at one place against each other.  Returns nothing inside the
// horizon if their tetrads differ.  With c = gamma v of each along axes of the sky, one observer
// has the Lorentz factor gamma gamma' - c.c' for the other.
std::optional<double> relative_speed(const ObserverState& a, const ObserverState& b) {
  V3d c = a.celerity, d = b.celerity;
  // Against different tetrads celerities do not compare, but each of them can be given against the
  // static observer, whom there is outside the horizon.
  if (a.tetrad != b.tetrad) {
    if (!has_rest(a) || !has_rest(b)) return std::nullopt;
    c = static_celerity(a), d = static_celerity(b);
  }
  const V3d difference = apply(a.sky_from_tetrad, c) - apply(b.sky_from_tetrad, d);
  // This form avoids cancellation: gamma_rel - 1 = (|c - d|^2 - (gamma - gamma')^2)/2, because
  // gamma^2 = 1 + c^2, and v = sqrt(gamma_rel^2 - 1)/gamma_rel.
  const double e = std::hypot(1.0, c.length()) - std::hypot(1.0, d.length());
  const double excess = std::max(0.0, (difference.length2() - e * e) / 2);
  return std::sqrt(excess * (excess + 2)) / (1 + excess);
}

// ---- between frames ----

// A FramePair says what changes from one frame to the next.
struct FramePair {
  double turn = 0, stops = 0;  // radians of the camera, EV of the exposure
  double gas = 0;              // radians by which the inner gas of a disc turns
  int segment = -1;            // -1 if a cut lies between them
  double unseen = 0;  // radians of the camera since the pair before, where frames are left out
};

// Returns the angle of the rotation from a to b.  The sum of |a - b|^2 over the elements is 6 - 2
// tr(a^T b) = 4 (1 - cos(angle)) = 8 sin^2(angle/2).
double angle_between(const M33d& a, const M33d& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += (a[i][j] - b[i][j]) * (a[i][j] - b[i][j]);
  return 2 * std::asin(std::min(1.0, std::sqrt(sum / 8)));
}

M33d on_sky(const ObserverState& o) {
  const M33d camera = base_from_camera(o);
  const auto axis = [&](int k) { return apply(o.sky_from_tetrad, column(camera, k)); };
  return from_columns(axis(0), axis(1), axis(2));
}

// Returns the change between neighbouring frames.  Across a cut nothing is compared, since a cut is
// meant to jump.
FramePair compare(const Show& show, const FrameState& a, const FrameState& b) {
  if (a.segment != b.segment) return {};
  FramePair pair{.turn = angle_between(on_sky(a.observer), on_sky(b.observer)),
                 .stops = b.settings.ev - a.settings.ev,
                 .segment = a.segment};
  // The turn against the hole is that in the tetrad, whose first axis is radial.  Near a charge it does
  // not depend on the tetrad.
  if (!is_flat(a.observer) && (a.observer.tetrad == b.observer.tetrad || show.spacetime.leads_on()))
    pair.turn = std::min(pair.turn,
                         angle_between(base_from_camera(a.observer), base_from_camera(b.observer)));
  // Rings look the same however they turn.
  if (show.disc && std::any_of(show.disc->patterns.begin(), show.disc->patterns.end(),
                               [](const PatternKind& pattern) {
                                 return !std::holds_alternative<RingPattern>(pattern);
                               }))
    pair.gas = show.disc->orbits.angular_velocity(
                   std::max(show.disc->inner, show.disc->orbits.last_stable())) *
               static_cast<double>(b.observer.null_time - a.observer.null_time);
  return pair;
}

struct Pairs {
  std::vector<int> frames;  // the second one of each pair
  std::vector<FramePair> pairs;
};

// Returns the second frames of the pairs to compare.  Between keyframes a camera turns smoothly,
// and each of its states takes milliseconds.  Every tenth frame is enough there, besides those next
// to the keyframes.
std::vector<int> chosen_frames(const Show& show) {
  constexpr int kWithinTurns = 10;
  const int count = frame_count(show), step = (count + kMostPairs - 1) / kMostPairs;
  std::vector<int> frames;
  for (int n = 1; n < count; n += step) {
    const auto segment = static_cast<std::size_t>(segment_at(show, n / show.frames_per_second));
    const std::vector<AttitudeKey>& keys = show.timeline[segment].attitudes;
    const auto is_near = [&](const AttitudeKey& key) {
      return std::abs(key.at_s * show.frames_per_second - n) <= 2;
    };
    if (keys.size() < 2 || n % kWithinTurns == 0 || std::ranges::any_of(keys, is_near))
      frames.push_back(n);
  }
  return frames;
}

Pairs compare_pairs(const Show& show, std::vector<int> frames) {
  // In chunks of 32 neighbours 33 states are computed for 32 pairs.
  constexpr std::size_t kTogether = 32;
  Pairs found{std::move(frames), {}};
  found.pairs.resize(found.frames.size());
  // Chunks are compared in parallel.  Within a chunk, the later state of one pair is the earlier of
  // the next.
  tbb::parallel_for(
      std::size_t{0}, (found.frames.size() + kTogether - 1) / kTogether, [&](std::size_t chunk) {
        std::optional<FrameState> before;
        if (chunk > 0) before = frame_state(show, found.frames[chunk * kTogether - 1]);
        const std::size_t end = std::min(found.frames.size(), (chunk + 1) * kTogether);
        for (std::size_t k = chunk * kTogether; k < end; ++k) {
          const int n = found.frames[k];
          double unseen = 0;
          if (!before || before->frame != n - 1) {
            const FrameState last = frame_state(show, n - 1);
            if (before) unseen = compare(show, *before, last).turn;
            before = last;
          }
          const FrameState now = frame_state(show, n);
          found.pairs[k] = compare(show, *before, now);
          found.pairs[k].unseen = unseen;
          before = now;
        }
      });
  return found;
}

// Compares the chosen frames, and those between two of them where the camera turns by more than it
// does at both, as when a body that it looks at is not seen before.
Pairs compare_frames(const Show& show) {
  Pairs found = compare_pairs(show, chosen_frames(show));
  std::vector<int> frames = found.frames;
  for (std::size_t k = 1; k < found.frames.size(); ++k) {
    const int first = found.frames[k - 1] + 1, end = found.frames[k];
    const double expected = (end - first) * std::max(found.pairs[k - 1].turn, found.pairs[k].turn);
    if (found.pairs[k].unseen <=
        2 * expected + kFastestTurnDeg / kRadianDeg / show.frames_per_second)
      continue;
    for (int n = first; n < end; ++n) frames.push_back(n);
  }
  if (frames.size() == found.frames.size()) return found;
  std::ranges::sort(frames);
  return compare_pairs(show, frames);
}

// Adds one warning for each run of neighbours beyond a limit, at its worst frame.  text_of(value)
// gives the words of the warning.
template <class TextOf>
void warn_of_runs(const Show& show, const Pairs& found, double FramePair::*quantity, double limit,
                  const TextOf& text_of, std::vector<ShowWarning>& warnings) {
  const auto size = [&](std::size_t k) { return std::abs(found.pairs[k].*quantity); };
  for (std::size_t k = 0; k < found.pairs.size(); ++k) {
    if (!(size(k) > limit)) continue;
    std::size_t worst = k;
    const int segment = found.pairs[k].segment;
    for (; k < found.pairs.size() && size(k) > limit && found.pairs[k].segment == segment; ++k)
      if (size(k) > size(worst)) worst = k;
    const int frame = found.frames[worst];
    warnings.push_back(
        {frame / show.frames_per_second, frame, segment, text_of(found.pairs[worst].*quantity)});
    // The loop above has gone one pair too far for the outer loop.
    --k;
  }
}

// ---- keyframes ----

// Warns of values that jump at keyframes with `ease: hold`.
class Holds {
 public:
  Holds(const Show& show, std::vector<ShowWarning>& warnings) : show_(show), warnings_(warnings) {}

  void all() {
    for (int k = 0; k < static_cast<int>(show_.timeline.size()); ++k) {
      const Segment& segment = segment_of(show_, k);
      for (const auto& [key, curve] : curves_of(show_, segment))
        // A jump of the exposure is found when frames are compared.
        if (key != key_of(Channel::kEv)) of_curve(k, *curve, key);
      for (std::size_t i = 1; i < segment.attitudes.size(); ++i)
        if (segment.attitudes[i].ease == Ease::kHold)
          add(k, segment.attitudes[i].at_s,
              "the camera's target is another at a keyframe that holds");
    }
  }

 private:
  void of_curve(int segment, const Curve& curve, const std::string& name) {
    for (std::size_t i = 1; i < curve.keys.size(); ++i)
      if (curve.keys[i].ease == Ease::kHold && curve.keys[i].value != curve.keys[i - 1].value)
        add(segment, curve.keys[i].at_s, fmt::format("{} jumps at a keyframe that holds", name));
  }

  // Adds a warning unless the jump is not seen: where the segment begins, or where another segment
  // or none is shown.
  void add(int segment, double at_s, const std::string& text) {
    const double begin = begin_of(show_, segment);
    const int frame = static_cast<int>(std::ceil(at_s * show_.frames_per_second - kCutTolerance));
    if (!(at_s > begin) || segment_at(show_, at_s) != segment || frame >= frame_count(show_))
      return;
    warnings_.push_back({at_s, frame, segment, text});
  }

  const Show& show_;
  std::vector<ShowWarning>& warnings_;
};

// Warns of joints at which place and velocity go on but the clock does not, unless a dissolve hides
// it.
void warn_of_rates(const Show& show, std::vector<ShowWarning>& warnings) {
  for (const SegmentJoint& j : segment_joints(show)) {
    const double least = std::min(j.rate_before, j.rate_after),
                 most = std::max(j.rate_before, j.rate_after);
    if (j.place_jumps() || j.velocity_jumps() || j.dissolve_s > 0) continue;
    // The rate at an end of a segment is a quotient of differences.  A clock that starts from
    // standstill therefore has a small rate, and only a clock that stands still before and after
    // has 0.
    if (most <= kLargestRateStep * least || most == 0) continue;
    const int frame =
        static_cast<int>(std::ceil(j.time_s * show.frames_per_second - kCutTolerance));
    warnings.push_back(
        {j.time_s, frame, j.segment,
         fmt::format("the motion goes on, but its clock jumps from {:.3g} to {:.3g} M a second",
                     j.rate_before, j.rate_after)});
  }
}

}  // namespace

bool SegmentJoint::place_jumps() const {
  constexpr double kSame = 1e-6;
  if (before != after && !are_apart(before.region, after.region)) return true;
  return r_before != r_after && !(std::abs(r_after - r_before) <= kSame * r_before);
}

bool SegmentJoint::velocity_jumps() const {
  constexpr double kSame = 1e-4;
  return speed && *speed > kSame;
}

std::vector<SegmentJoint> segment_joints(const Show& show) {
  std::vector<SegmentJoint> joints;
  const std::vector<double> times = segment_times(show);
  for (std::size_t k = 1; k < show.timeline.size(); ++k) {
    const int later = static_cast<int>(k);
    const ObserverState a = observer_at(show, later - 1, 1), b = observer_at(show, later, 0);
    SegmentJoint j;
    j.segment = later, j.time_s = times[k], j.dissolve_s = show.timeline[k].dissolve_s;
    j.r_before = a.r, j.r_after = b.r;
    j.before = {a.region, a.universe}, j.after = {b.region, b.universe};
    // A speed against each other has a meaning only for observers at one place.
    if (!j.place_jumps()) j.speed = relative_speed(a, b);
    j.rate_before = clock_rate(show.timeline[k - 1], 1),
    j.rate_after = clock_rate(show.timeline[k], 0);
    joints.push_back(j);
  }
  return joints;
}

std::vector<ShowWarning> jump_warnings(const Show& show) {
  std::vector<ShowWarning> warnings;
  const Pairs found = compare_frames(show);
  const double deg_per_s = kRadianDeg * show.frames_per_second;  // equals a radian a frame
  // A change that a show states as exactly the limit may come out above it by rounding.
  constexpr double kRounding = 1e-9;
  warn_of_runs(
      show, found, &FramePair::turn, kFastestTurnDeg / deg_per_s * (1 + kRounding),
      [&](double turn) {
        return fmt::format("the camera turns by {:.3g} degrees a second", turn * deg_per_s);
      },
      warnings);
  warn_of_runs(
      show, found, &FramePair::stops, kLargestEvStep * (1 + kRounding),
      [](double stops) {
        return fmt::format("the exposure changes by {:+.3g} stops between frames", stops);
      },
      warnings);
  warn_of_runs(
      show, found, &FramePair::gas, kFastestGasDeg / kRadianDeg,
      [](double gas) {
        return fmt::format(
            "the disc's inner gas turns by {:.3g} degrees from frame to frame, so that its pattern "
            "seems to jump or to stand; a slower clock would show how it moves",
            std::abs(gas) * kRadianDeg);
      },
      warnings);
  warn_of_rates(show, warnings);
  Holds(show, warnings).all();
  std::ranges::stable_sort(warnings, {}, &ShowWarning::time_s);
  return warnings;
}

}  // namespace domefall
