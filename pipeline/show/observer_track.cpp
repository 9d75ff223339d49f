#include "pipeline/show/observer_track.h"

#include <algorithm>
#include <cmath>

#include "trajectories/passages.h"

namespace domefall {
namespace {

// The tortoise coordinate r* = r + 2 ln|r/2 - 1|, with which v = u + 2 r*.
double tortoise(double r) { return r + 2 * std::log(std::abs(r / 2 - 1)); }

// The integral from 0 to t of the rate a + (b - a) (3 t^2 - 2 t^3).
double ramp(double a, double b, double t) { return t * (a + (b - a) * t * t * (1 - t / 2)); }

// What one segment hands over to the next.
struct Joint {
  M33d axes;
  double azimuth = 0;
  DoubleDouble null_time{};
  Tetrad tetrad = Tetrad::kRain;
  double r = kFlatSpace;
};

// What must be added to the null time of a trajectory, so that it goes on from the joint.  Between
// v and u it changes by 2 r*.  Where the two do not meet, the count starts at 0 again.
DoubleDouble null_offset(const Joint& joint, const OrbitPoint& start) {
  DoubleDouble reached = joint.null_time;
  if (start.tetrad != joint.tetrad) {
    const bool same_sky = is_mirrored(start.tetrad) == is_mirrored(joint.tetrad);
    if (!same_sky || !(joint.r > 2) || std::isinf(joint.r)) return -start.null_time;
    reached = reached + (is_outgoing(start.tetrad) ? -2 : 2) * tortoise(joint.r);
  }
  return reached - start.null_time;
}

OrbitPoint point_of(const Segment& s, const ProperTime& tau) {
  return placed(point_at(s.trajectory, tau), s.placement);
}

// From one time to another, in equal factors.
double ratio_between(double from, double to, double part) {
  return part < 1 ? from * std::pow(to / from, part) : to;
}

// The time when `done` of what lies between has passed and `left` = 1 - done is to come.  Next to
// the end it counts back from there: the end may be closer to a singularity than the rounding of
// the whole time.
ProperTime part_between(const ProperTime& from, const ProperTime& to, double done, double left) {
  constexpr double kNextToTheEnd = 1e-3;
  const double span = double(to - from);
  return left < kNextToTheEnd ? to - span * left : from + span * done;
}

}  // namespace

ProperTime proper_time_at(const Segment& s, double part) {
  const ProperTime &from = s.timing.tau_begin, &to = s.timing.tau_end;
  switch (s.timing.pace) {
    case Pace::kSlowing: {
      const ProperTime end = lifetime(s.trajectory);
      return end - ratio_between(double(end - from), double(end - to), part);
    }
    case Pace::kQuickening: {
      const ProperTime start = birth(s.trajectory);
      return start + ratio_between(double(from - start), double(to - start), part);
    }
    case Pace::kEased:
      return part_between(from, to, smooth_step(part), smooth_step(1 - part));
    case Pace::kSteady:
      break;
  }
  const double begins = s.timing.rate_begin, ends = s.timing.rate_end;
  return part_between(from, to, ramp(begins, ends, part), ramp(ends, begins, 1 - part));
}

ObserverState observer_at(const Show& show, int segment, double part) {
  Joint joint{place_tetrad(show.hole_at, show.heading, 0)};
  for (int k = 0;; ++k) {
    const Segment& s = segment_of(show, k);
    const OrbitPoint start = point_of(s, s.timing.tau_begin);
    if (k == 0) joint.tetrad = start.tetrad, joint.null_time = 0;
    const ProperTime tau = k == segment ? proper_time_at(s, part) : s.timing.tau_end;
    const OrbitPoint point = point_of(s, tau);
    joint.axes = moved_on(turned(joint.axes, s.placement.turn), point.azimuth - start.azimuth);
    joint.azimuth += point.azimuth - start.azimuth;
    joint.null_time = point.null_time + null_offset(joint, start);
    joint.tetrad = point.tetrad, joint.r = point.r;
    if (k < segment) continue;
    ObserverState o;
    o.region = point.region, o.tetrad = point.tetrad, o.r = point.r;
    o.proper_time = double(tau);
    o.celerity = point.celerity;
    o.null_time = double(joint.null_time);
    o.azimuth = joint.azimuth;
    o.sky_from_tetrad = joint.axes;
    return o;
  }
}

int segment_at(const Show& show, double show_time_s) {
  const std::vector<double> times = segment_times(show);
  const double t = show_time_s + kCutTolerance / show.frames_per_second;
  int segment = 0;
  while (segment + 1 < static_cast<int>(show.timeline.size()) &&
         t >= times[static_cast<std::size_t>(segment) + 1])
    ++segment;
  return segment;
}

double part_at(const Show& show, int segment, double show_time_s) {
  const double begin = segment_times(show)[static_cast<std::size_t>(segment)];
  return std::clamp((show_time_s - begin) / segment_of(show, segment).duration_s, 0.0, 1.0);
}

}  // namespace domefall
