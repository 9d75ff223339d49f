#include "pipeline/show/observer_track.h"

#include <algorithm>
#include <cmath>

#include "pipeline/show/carried_camera.h"
#include "pipeline/show/curve.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

// The rain and the outgoing tetrad of one sky are both regular only outside its horizon, and inside
// an inner one.  r* is infinite there and in flat space.
bool has_both_tetrads(const Joint& joint) {
  return !joint.spacetime.is_flat() &&
         (joint.r > joint.spacetime.horizon() || is_within_inner_horizon(joint.region));
}

// Returns what must be added to the null time of a trajectory, so that it goes on from the joint.
// Between v and u it changes by 2 r*.  Where the two do not meet, the count starts at 0 again.
DoubleDouble null_offset(const Joint& joint, const OrbitPoint& start) {
  DoubleDouble reached = joint.null_time;
  if (start.tetrad != joint.tetrad) {
    const bool same_sky = is_mirrored(start.tetrad) == is_mirrored(joint.tetrad);
    if (!same_sky || !has_both_tetrads(joint)) return -start.null_time;
    reached = reached + (is_outgoing(start.tetrad) ? -2 : 2) * joint.spacetime.tortoise(joint.r);
  }
  return reached - start.null_time;
}

// Returns the universe in which an orbit goes on from the joint.  Above the inside of an inner
// horizon lies region IV of the next universe.
int universe_into(const Joint& joint, const OrbitPoint& start) {
  return joint.universe + (is_within_inner_horizon(joint.region) && start.region == Region::kIV) -
         (joint.region == Region::kIV && is_within_inner_horizon(start.region));
}

OrbitPoint point_of(const Segment& s, const ProperTime& tau) {
  return placed(point_at(s.trajectory, tau), s.placement);
}

// Returns the joint as the segment hands it over where its observer is at `point`.
Joint moved(Joint joint, const Segment& s, const OrbitPoint& point) {
  const OrbitPoint start = point_of(s, s.timing.tau_begin);
  // The plane turns first, and the azimuth is then swept in the new one.
  const double swept = point.azimuth - start.azimuth;
  const auto* hole = std::get_if<SpinningHole>(&joint.spacetime.kind());
  joint.axes = hole ? moved_about(axis_of(*hole), joint.axes, point.theta, swept)
                    : moved_on(turned(joint.axes, s.placement.turn), swept);
  joint.azimuth += point.azimuth - start.azimuth;
  joint.null_time = point.null_time + null_offset(joint, start);
  joint.universe = universe_into(joint, start) + point.universe - start.universe;
  joint.region = point.region, joint.tetrad = point.tetrad, joint.r = point.r;
  return joint;
}

// Returns the joint of a segment, which is followed from the start in a show that has not stored
// it.
Joint joint_of(const Show& show, int segment) {
  if (!show.joints.empty()) return show.joints[static_cast<std::size_t>(segment)];
  Joint joint = first_joint(show, show.timeline.front());
  for (int k = 0; k < segment; ++k)
    joint = joint_into(joint_after(joint, segment_of(show, k)), segment_of(show, k + 1));
  return joint;
}

// Returns the value that lies a part of the way from one to another in equal factors.  At the end
// it is `to` itself, without the rounding of the power.
double ratio_between(double from, double to, double part) {
  return part < 1 ? from * std::pow(to / from, part) : to;
}

// Returns the time when `done` of what lies between has passed and `left` = 1 - done is to come.
// Next to the end it counts back from there, since the end may be closer to a singularity than the
// rounding of the whole time.
ProperTime part_between(const ProperTime& from, const ProperTime& to, double done, double left) {
  constexpr double kNextToTheEnd = 1e-3;
  const double span = double(to - from);
  return left < kNextToTheEnd ? to - span * left : from + span * done;
}

// Returns the time at which r has gone `part` of its way in equal factors.  Rounding of r can move
// a passage next to the beginning out of the segment, and then the time itself is divided.
ProperTime time_of_even_log_r(const Segment& s, double part) {
  const ProperTime &from = s.timing.tau_begin, &to = s.timing.tau_end;
  if (!(part > 0)) return from;
  if (!(part < 1)) return to;
  const double begin = point_at(s.trajectory, from).r, end = point_at(s.trajectory, to).r;
  const auto tau = time_at(s.trajectory, ratio_between(begin, end, part),
                           end < begin ? Leg::kInward : Leg::kOutward, from);
  return tau && *tau >= from && *tau <= to ? *tau : part_between(from, to, part, 1 - part);
}

}  // namespace

ProperTime proper_time_at(const Segment& s, double part) {
  const ProperTime &from = s.timing.tau_begin, &to = s.timing.tau_end;
  switch (s.timing.pace) {
    case Pace::kSlowing: {
      // The time that is left to the trajectory shrinks by equal factors.  Next to the singularity
      // r goes with a power of that time (2/3 for a radial fall, 2/5 with angular momentum), so
      // that log r falls evenly.
      const ProperTime end = lifetime(s.trajectory);
      return end - ratio_between(double(end - from), double(end - to), part);
    }
    case Pace::kQuickening: {
      // The time since the trajectory began grows by equal factors.
      const ProperTime start = birth(s.trajectory);
      return start + ratio_between(double(from - start), double(to - start), part);
    }
    case Pace::kLogRadius:
      return time_of_even_log_r(s, part);
    case Pace::kEased:
      return part_between(from, to, smooth_step(part), smooth_step(1 - part));
    case Pace::kSteady:
      break;
  }
  const double begins = s.timing.rate_begin, ends = s.timing.rate_end;
  // The part to come has a law of its own, since 1 - x would lose its digits next to the end.
  return part_between(from, to, part_passed(begins, ends, part),
                      part_passed(ends, begins, 1 - part));
}

Joint first_joint(const Show& show, const Segment& first) {
  const OrbitPoint start = point_of(first, first.timing.tau_begin);
  Joint joint{.axes = place_tetrad(show.hole_at, show.heading, 0),
              .spacetime = show.spacetime,
              .region = start.region,
              .tetrad = start.tetrad};
  return joint_into(joint, first);
}

Joint joint_after(const Joint& joint, const Segment& segment) {
  return moved(joint, segment, point_of(segment, segment.timing.tau_end));
}

Joint joint_into(const Joint& reached, const Segment& next) {
  if (!next.placement.beginning) return reached;
  const OrbitPoint point = point_of(next, next.timing.tau_begin);
  Joint joint = reached;
  joint.axes = next.placement.beginning->axes;
  joint.null_time = next.placement.beginning->null_time;
  joint.universe = universe_into(reached, point);
  joint.region = point.region, joint.tetrad = point.tetrad, joint.r = point.r;
  return joint;
}

double rain_time(const Joint& joint) {
  if (is_mirrored(joint.tetrad)) return 0;
  if (!is_outgoing(joint.tetrad)) return double(joint.null_time);
  return has_both_tetrads(joint) ? double(joint.null_time) + 2 * joint.spacetime.tortoise(joint.r)
                                 : 0;
}

void join_segments(Show& show) {
  const std::vector<double> times = segment_times(show);
  show.joints.clear();
  for (const Segment& segment : show.timeline) {
    const std::size_t k = show.joints.size();
    show.joints.push_back(
        k == 0 ? first_joint(show, segment)
               : joint_into(joint_after(show.joints.back(), show.timeline[k - 1]), segment));
    show.joints.back().begin_s = times[k];
    if (segment.camera.frame == CameraFrame::kGyroscope)
      show.joints.back().gyroscope = gyroscope_of(show.spacetime, segment);
  }
}

double begin_of(const Show& show, int segment) {
  const auto k = static_cast<std::size_t>(segment);
  return show.joints.empty() ? segment_times(show)[k] : show.joints[k].begin_s;
}

ObserverState observer_at(const Show& show, int segment, double part) {
  const Segment& s = segment_of(show, segment);
  const ProperTime tau = proper_time_at(s, part);
  const OrbitPoint point = point_of(s, tau);
  const Joint joint = moved(joint_of(show, segment), s, point);
  ObserverState o;
  o.spacetime = show.spacetime;
  o.region = point.region, o.tetrad = point.tetrad, o.r = point.r;
  o.universe = joint.universe, o.l = point.l;
  o.proper_time = double(tau);
  o.celerity = point.celerity;
  o.null_time = double(joint.null_time);
  o.azimuth = joint.azimuth;
  o.sky_from_tetrad = joint.axes;
  o.mouth_at_start = show.hole_at.v;
  return o;
}

int segment_at(const Show& show, double show_time_s) {
  const double t = show_time_s + kCutTolerance / show.frames_per_second;
  // Bisection finds the last segment that has begun.
  int begun = 0, later = static_cast<int>(show.timeline.size());
  while (later - begun > 1) {
    const int middle = begun + (later - begun) / 2;
    (t >= begin_of(show, middle) ? begun : later) = middle;
  }
  return begun;
}

double part_at(const Show& show, int segment, double show_time_s) {
  return std::clamp((show_time_s - begin_of(show, segment)) / segment_of(show, segment).duration_s,
                    0.0, 1.0);
}

}  // namespace domefall
