#include "pipeline/program/survey/show_survey.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "pipeline/render/rays/shift_range.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

// A segment has as many samples as frames, within these bounds.  They are enough that an orbit has
// at most one turning point between two samples.
constexpr int kLeastSurveySamples = 512, kMostSurveySamples = 20'000;
// This is about half the bits of a double.  Near a minimum r is quadratic in time, so that a closer
// time would change it by less than rounding.
constexpr int kMinimumBits = 26;
constexpr double kCrossed = 1e-6;  // of r + 1 M: a horizon is not crossed twice within that time

void add(std::vector<Visit>& visits, const Visit& visit) {
  if (visits.empty() || visits.back() != visit) visits.push_back(visit);
}

// Returns the last frame that is not later than an instant.  An instant at most kCutTolerance
// frames before a frame counts as that frame's, since it is a sum of rounded durations.
int frame_at(const Show& show, double time_s) {
  const double frame = std::floor(time_s * show.frames_per_second + kCutTolerance);
  return std::clamp(static_cast<int>(frame), 0, frame_count(show) - 1);
}

// A SampledPath is the part of its trajectory that a segment shows, sampled in proper time.
class SampledPath {
 public:
  // `universe` is that of its beginning.
  SampledPath(const Show& show, const Segment& segment, int universe)
      : spacetime_(show.spacetime), segment_(segment) {
    const ProperTime &begin = segment.timing.tau_begin, &end = segment.timing.tau_end;
    universe_ = universe - at(begin).universe;
    const int samples =
        static_cast<int>(std::clamp(segment.duration_s * show.frames_per_second,
                                    double{kLeastSurveySamples}, double{kMostSurveySamples}));
    // The radius repeats itself after a period, so that samples of one period are enough.
    const double step = std::min(double(end - begin), radial_period(segment.trajectory)) / samples;
    for (int k = 0; k <= samples; ++k) taus_.push_back(std::min(end, begin + step * k));
    taus_.push_back(end);
    // A path between two singularities is highest at proper time 0, and it may visit region I only
    // for a short time.
    if (begin < 0 && 0 < end) taus_.emplace_back(0);
    add_periastron(begin, end);
    add_crossings(begin, end);
    std::sort(taus_.begin(), taus_.end());
  }

  // Says which regions are visited, and which skies are seen.
  void survey(std::vector<Visit>& visits, PerSky<bool>& skies) const {
    for (const ProperTime& tau : taus_) {
      const OrbitPoint p = at(tau);
      const int universe = universe_ + p.universe;
      add(visits, {p.region, universe});
      const PerSky<bool> seen = spacetime_.seen_skies(p.region, p.tetrad, universe, p.r);
      for (const SkyRegion sky : kExteriorSkies) skies[sky] = skies[sky] || seen[sky];
    }
  }

  // Returns the proper time and the value of the least r.  Brent's method refines the least sample
  // between its neighbours.
  std::pair<ProperTime, double> closest() const {
    std::size_t least = 0;
    for (std::size_t k = 1; k < taus_.size(); ++k)
      if (at(taus_[k]).r < at(taus_[least]).r) least = k;
    const ProperTime tau = taus_[least];
    const double r = at(tau).r, before = double(taus_[least > 0 ? least - 1 : 0] - tau),
                 after = double(taus_[std::min(least + 1, taus_.size() - 1)] - tau);
    if (!(before < after) || std::isinf(r)) return {tau, r};
    const auto [later, lower] = boost::math::tools::brent_find_minima(
        [this, &tau](double t) { return at(tau + t).r; }, before, after, kMinimumBits);
    return lower < r ? std::pair{tau + later, lower} : std::pair{tau, r};
  }

 private:
  // Adds the passage of the periastron.  An orbit that comes from far away is near it for much less
  // than a sample's time.
  void add_periastron(const ProperTime& begin, const ProperTime& end) {
    const auto tau = next_periastron(segment_.trajectory, begin);
    if (tau && *tau < end) taus_.push_back(*tau);
  }

  // Adds an instant of each stay between the horizons, and inside the inner one.  An orbit that comes
  // from far away is there for much less than a sample's time, and comes into another universe in
  // each period.
  void add_crossings(const ProperTime& begin, const ProperTime& end) {
    const auto* hole = std::get_if<ChargedHole>(&spacetime_.kind());
    if (!hole || hole->is_naked()) return;
    std::vector<ProperTime> crossed;
    // An extremal hole has nothing between its horizons.
    const double outer = hole->horizon(), inner = hole->inner_horizon();
    for (const double r : inner < outer ? std::vector{outer, inner} : std::vector{outer})
      for (const Leg leg : {Leg::kInward, Leg::kOutward}) {
        auto tau = time_at(segment_.trajectory, r, leg, begin);
        for (; tau && *tau < end && crossed.size() < kMostSurveySamples;
             tau = time_at(segment_.trajectory, r, leg, *tau + kCrossed * (1 + r)))
          crossed.push_back(*tau);
      }
    std::sort(crossed.begin(), crossed.end());
    for (std::size_t k = 1; k < crossed.size(); ++k)
      taus_.push_back(crossed[k - 1] + double(crossed[k] - crossed[k - 1]) / 2);
  }

  OrbitPoint at(const ProperTime& tau) const {
    return placed(point_at(segment_.trajectory, tau), segment_.placement);
  }

  const Spacetime& spacetime_;
  const Segment& segment_;
  int universe_ = 0;  // of the trajectory's first one
  std::vector<ProperTime> taus_;
};

// Returns the part of a segment, 0 to 1, after which its clock shows tau.  It is found by
// bisection.
double part_of(const Segment& segment, const ProperTime& tau) {
  // 2^-60 is far below the spacing of doubles near 1.
  constexpr int kSteps = 60;
  if (tau <= segment.timing.tau_begin) return 0;
  if (tau >= segment.timing.tau_end) return 1;
  double low = 0, high = 1;
  for (int k = 0; k < kSteps; ++k) {
    const double middle = (low + high) / 2;
    (proper_time_at(segment, middle) < tau ? low : high) = middle;
  }
  return high;
}

SegmentSurvey survey_segment(const Show& show, int k, double begin_s) {
  const Segment& segment = segment_of(show, k);
  const Timing& timing = segment.timing;
  const SampledPath path(show, segment, observer_at(show, k, 0).universe);
  SegmentSurvey s;
  s.type = segment.type;
  s.begin_s = begin_s, s.end_s = begin_s + segment.duration_s, s.dissolve_s = segment.dissolve_s;
  const OrbitPoint begin = point_at(segment.trajectory, timing.tau_begin),
                   end = point_at(segment.trajectory, timing.tau_end);
  s.r_begin = begin.r, s.r_end = end.r;
  s.l_begin = begin.l, s.l_end = end.l;
  const auto [tau, r] = path.closest();
  s.closest = {r, begin_s + segment.duration_s * part_of(segment, tau), 0, k};
  s.closest.frame = frame_at(show, s.closest.time_s);
  path.survey(s.visits, s.skies);
  s.proper_time = double(timing.tau_end - timing.tau_begin);
  s.rate_begin = clock_rate(segment, 0), s.rate_end = clock_rate(segment, 1);
  return s;
}

// An Extremes keeps the fastest observer and the most shifted light of the frames that are added.
class Extremes {
 public:
  explicit Extremes(const Show& show, ShowSurvey& found) : show_(show), found_(found) {}

  void add(const FrameState& state) {
    const ObserverState& o = state.observer;
    if (has_rest(o)) raise(found_.fastest, static_celerity(o).length(), state);
    const FramePlan plan = plan_frame(show_, state);
    for (const SkyRegion sky : kExteriorSkies) {
      if (!plan[sky].lit()) continue;
      const auto range = frequency_range(o, sky, !show_.effects.lensing);
      if (!range) continue;
      // The frequency ratio is 1/(1 + z).
      raise(found_.reddest, 1 / range->least, state);
      lower(found_.bluest, 1 / range->largest, state);
    }
  }

 private:
  static Extreme extreme(double value, const FrameState& state) {
    return {value, state.show_time_s, state.frame, state.segment};
  }
  static void raise(std::optional<Extreme>& most, double value, const FrameState& state) {
    if (!most || value > most->value) most = extreme(value, state);
  }
  static void lower(std::optional<Extreme>& least, double value, const FrameState& state) {
    if (!least || value < least->value) least = extreme(value, state);
  }

  const Show& show_;
  ShowSurvey& found_;
};

}  // namespace

// At an end of the segment the difference is taken on its inner side.
double clock_rate(const Segment& segment, double part) {
  constexpr double kStep = 1e-6;
  const double from = std::clamp(part - kStep / 2, 0.0, 1 - kStep);
  return double(proper_time_at(segment, from + kStep) - proper_time_at(segment, from)) /
         (kStep * segment.duration_s);
}

ShowSurvey survey(const Show& show, const std::function<void(const FrameState&)>& see) {
  ShowSurvey found;
  const std::vector<double> times = segment_times(show);
  for (std::size_t k = 0; k < show.timeline.size(); ++k) {
    found.segments.push_back(survey_segment(show, static_cast<int>(k), times[k]));
    const SegmentSurvey& s = found.segments.back();
    for (const Visit& visit : s.visits) add(found.visits, visit);
    for (const SkyRegion sky : kExteriorSkies) found.skies[sky] = found.skies[sky] || s.skies[sky];
    if (!show.spacetime.is_flat() && (!found.closest || s.closest.value < found.closest->value))
      found.closest = s.closest;
  }
  // The camera's direction does not matter here, so targets are removed: axes that follow a
  // keyframed target take milliseconds to find.
  Show without_targets = show;
  for (Segment& segment : without_targets.timeline)
    segment.attitudes.clear(), segment.camera.attitude = EulerAngles{};
  Extremes extremes(show, found);
  const int frames = frame_count(show);
  for (int n = 0; n < frames; ++n) {
    const FrameState state = frame_state(without_targets, n);
    if (see) see(state);
    extremes.add(state);
    if (state.vanishing) extremes.add(*state.vanishing);
  }
  return found;
}

}  // namespace domefall
