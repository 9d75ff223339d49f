#include "pipeline/survey/show_survey.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

#include "pipeline/optics/silhouette.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/show/vantage.h"

namespace domefall {
namespace {

// Samples of a segment between which an orbit has one turning point at most, and the most of them for a
// long one.
constexpr int kLeastSamples = 512, kMostSamples = 20'000;
// Half the digits of a double: a minimum is no sharper.
constexpr int kMinimumBits = 26;

void visit(std::vector<Region>& regions, Region region) {
  if (regions.empty() || regions.back() != region) regions.push_back(region);
}

int frame_at(const Show& show, double time_s) {
  const double frame = std::floor(time_s * show.frames_per_second + kCutTolerance);
  return std::clamp(static_cast<int>(frame), 0, frame_count(show) - 1);
}

// The least r, and all regions, of the part of its trajectory that a segment shows.
class Way {
 public:
  Way(const Segment& segment, int frames)
      : segment_(segment), begin_(segment.timing.tau_begin), end_(segment.timing.tau_end) {
    const int samples = std::clamp(frames, kLeastSamples, kMostSamples);
    const double span = end_ - begin_, step = std::min(span, period()) / samples;
    for (int k = 0; k <= samples; ++k) taus_.push_back(std::min(end_, begin_ + step * k));
    taus_.push_back(end_);
    // The highest point of a way between two singularities: region I may be a short visit.
    if (begin_ < 0 && 0 < end_) taus_.push_back(0);
    std::sort(taus_.begin(), taus_.end());
  }

  std::vector<Region> regions() const {
    std::vector<Region> regions;
    for (const double tau : taus_) visit(regions, at(tau).region);
    return regions;
  }

  // Proper time and value of the least r.
  std::pair<double, double> closest() const {
    std::size_t least = 0;
    for (std::size_t k = 1; k < taus_.size(); ++k)
      if (at(taus_[k]).r < at(taus_[least]).r) least = k;
    const double tau = taus_[least], r = at(tau).r;
    const double before = taus_[least > 0 ? least - 1 : 0],
                 after = taus_[std::min(least + 1, taus_.size() - 1)];
    if (!(before < after) || std::isinf(r)) return {tau, r};
    const auto refined = boost::math::tools::brent_find_minima([this](double t) { return at(t).r; },
                                                               before, after, kMinimumBits);
    return refined.second < r ? refined : std::pair{tau, r};
  }

 private:
  OrbitPoint at(double tau) const {
    return placed(point_at(segment_.trajectory, tau), segment_.placement);
  }

  // After which r repeats itself.
  double period() const {
    const auto* orbit = std::get_if<Geodesic>(&segment_.trajectory);
    return orbit ? orbit->radial_period() : HUGE_VAL;
  }

  const Segment& segment_;
  double begin_, end_;
  std::vector<double> taus_;
};

// The part of a segment after which its clock shows tau, by bisection.
double part_of(const Segment& segment, double tau) {
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
  const Segment& segment = show.timeline[static_cast<std::size_t>(k)];
  const Timing& timing = segment.timing;
  const Way way(segment, static_cast<int>(std::min(segment.duration_s * show.frames_per_second,
                                                   double{kMostSamples})));
  SegmentSurvey s;
  s.type = segment.type;
  s.begin_s = begin_s, s.end_s = begin_s + segment.duration_s, s.dissolve_s = segment.dissolve_s;
  s.r_begin = point_at(segment.trajectory, timing.tau_begin).r;
  s.r_end = point_at(segment.trajectory, timing.tau_end).r;
  const auto [tau, r] = way.closest();
  s.closest = {r, begin_s + segment.duration_s * part_of(segment, tau), 0, k};
  s.closest.frame = frame_at(show, s.closest.time_s);
  s.regions = way.regions();
  s.proper_time = timing.tau_end - timing.tau_begin;
  s.rate_begin = clock_rate(segment, 0), s.rate_end = clock_rate(segment, 1);
  return s;
}

class Extremes {
 public:
  explicit Extremes(const Show& show, ShowSurvey& found) : show_(show), found_(found) {}

  void add(const FrameState& state) {
    const ObserverState& o = state.observer;
    if (o.r > 2) raise(found_.fastest, static_celerity(o).length(), state);
    const FramePlan plan = plan_frame(show_, state);
    const SkyRegion home = home_sky(o.tetrad), far = far_sky(o.tetrad);
    for (const bool is_far : {false, true}) {
      if (!plan[is_far ? far : home].lit()) continue;
      const auto range = frequency_range(o, is_far, !show_.effects.lensing);
      if (!range) continue;
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

// Rain's components of gamma v that is given against the outgoing frame; r > 2.  The two frames recede
// from each other at 2s/(1 + s^2).
V3d in_rain(const V3d& c, double s) {
  const double below = (1 - s) * (1 + s), gamma = std::sqrt(1 + c.length2());
  return {((1 + s * s) * c.x + 2 * s * gamma) / below, c.y, c.z};
}

struct Plane {
  double gamma, radial, across, s;

  // gamma + c.n = 1/(gamma + |c|) + |c| (1 + cos) does not cancel behind a fast observer.
  double ratio(double angle) const {
    const double length = std::hypot(radial, across);
    const double half = std::cos((angle - std::atan2(across, radial)) / 2);
    return (1 / (gamma + length) + 2 * length * half * half) / std::abs(1 + s * std::cos(angle));
  }
};

}  // namespace

double clock_rate(const Segment& segment, double part) {
  constexpr double kStep = 1e-6;
  const double from = std::clamp(part - kStep / 2, 0.0, 1 - kStep);
  return (proper_time_at(segment, from + kStep) - proper_time_at(segment, from)) /
         (kStep * segment.duration_s);
}

V3d static_celerity(const ObserverState& o) {
  if (is_flat(o)) return o.celerity;
  // dr/dtau over sqrt(1 - 2/r); the reference frame falls with -s or rises with s.
  const double s = std::sqrt(2 / o.r), gamma = std::sqrt(1 + o.celerity.length2());
  const double rate = o.celerity.x + (is_outgoing(o.tetrad) ? s * gamma : -s * gamma);
  return {rate / std::sqrt((o.r - 2) / o.r), o.celerity.y, o.celerity.z};
}

std::optional<ShiftRange> frequency_range(const ObserverState& o, bool far, bool straight) {
  if (o.region == Region::kIV || (far && !(o.r < 2))) return std::nullopt;
  if (straight || is_flat(o)) {
    const double speed = static_celerity(o).length(), gamma = std::hypot(1.0, speed);
    const double hole = is_flat(o) ? 1 : gravitational_ratio(o.r);
    return ShiftRange{hole / (gamma + speed), hole * (gamma + speed)};
  }
  const double s = std::sqrt(2 / o.r);
  const V3d c = is_outgoing(o.tetrad) ? in_rain(o.celerity, s) : o.celerity;
  const Plane plane{std::sqrt(1 + c.length2()), c.x, std::hypot(c.y, c.z), s};
  // Angles from R: the home sky reaches to the silhouette, the far one from its edge to -R.
  const double edge = std::numbers::pi - (far ? region_three_edge(o.r) : silhouette_edge(o.r));
  std::vector<double> angles{edge, -edge, far ? std::numbers::pi : 0};
  const double b = s * plane.gamma - plane.radial, length = std::hypot(plane.across, b);
  const double cosine = -s * plane.across / length;
  if (length > 0 && std::abs(cosine) <= 1) {
    const double axis = std::atan2(b, plane.across), apart = std::acos(cosine);
    for (const double angle : {axis + apart, axis - apart}) {
      const double wrapped = std::remainder(angle, 2 * std::numbers::pi);
      if (far ? std::abs(wrapped) > edge : std::abs(wrapped) < edge) angles.push_back(wrapped);
    }
  }
  ShiftRange range{HUGE_VAL, 0};
  for (const double angle : angles) {
    const double ratio = plane.ratio(angle);
    range = {std::min(range.least, ratio), std::max(range.largest, ratio)};
  }
  return range;
}

ShowSurvey survey(const Show& show) {
  ShowSurvey found;
  const std::vector<double> times = segment_times(show);
  for (std::size_t k = 0; k < show.timeline.size(); ++k) {
    found.segments.push_back(survey_segment(show, static_cast<int>(k), times[k]));
    const SegmentSurvey& s = found.segments.back();
    for (const Region region : s.regions) visit(found.regions, region);
    if (show.mass_solar && (!found.closest || s.closest.value < found.closest->value))
      found.closest = s.closest;
  }
  // Where it looks does not matter here, and may be long to find.
  Show blind = show;
  for (Segment& segment : blind.timeline)
    segment.attitudes.clear(), segment.camera.attitude = EulerAngles{};
  Extremes extremes(show, found);
  const int frames = frame_count(show);
  for (int n = 0; n < frames; ++n) {
    const FrameState state = frame_state(blind, n);
    extremes.add(state);
    if (state.vanishing) extremes.add(*state.vanishing);
  }
  return found;
}

}  // namespace domefall
