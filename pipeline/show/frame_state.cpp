#include "pipeline/show/frame_state.h"

#include <cmath>

#include "pipeline/optics/aberration.h"
#include "pipeline/optics/hole_optics.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

// Scene "up" where a target leaves it free: the north of the orbit, -Theta, or of the sky where there
// is no hole to orbit; outward (R) for a target within 0.06 degrees of that axis.
V3d up_across(const V3d& target, const ObserverState& o) {
  const V3d north = is_flat(o) ? apply_transposed(o.sky_from_tetrad, V3d(0, 0, 1)) : V3d(0, -1, 0);
  const V3d outward(1, 0, 0);
  const V3d up = target.cross(north).length() > 1e-3 ? north : outward;
  return (up - target * up.dot(target)).normalized();
}

M33d rolled(const V3d& x, const V3d& y, const V3d& z, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return from_columns(x * c - y * s, y * c + x * s, z);
}

// [Riazuelo] sec. sec_cam: A, B, C are the boosted Theta, Phi, R.
M33d euler_axes(const EulerAngles& angle) {
  const V3d a(0, 1, 0), b(0, 0, 1), c(1, 0, 0);
  const V3d a1 = a * std::cos(angle.phi) + b * std::sin(angle.phi);
  const V3d b1 = b * std::cos(angle.phi) - a * std::sin(angle.phi);
  const V3d z = c * std::cos(angle.vartheta) + a1 * std::sin(angle.vartheta);
  const V3d a2 = a1 * std::cos(angle.vartheta) - c * std::sin(angle.vartheta);
  return from_columns(a2 * std::cos(angle.psi) + b1 * std::sin(angle.psi),
                      b1 * std::cos(angle.psi) - a2 * std::sin(angle.psi), z);
}

// What stood at elevation e in the front stands at e + tilt.
M33d tilted(const M33d& axes, double tilt) {
  const V3d y = column(axes, 1), z = column(axes, 2);
  const double c = std::cos(tilt), s = std::sin(tilt);
  return from_columns(column(axes, 0), y * c - z * s, y * s + z * c);
}

// Of a frame: durations such as 0.1 s add up to a little more than the instant they mean, and the
// frame at a cut belongs to what follows it.
constexpr double kCutTolerance = 1e-6;

// `part` of the segment's duration has passed.
double proper_time_at(const Segment& s, double part) {
  if (s.pace == Pace::kSteady) return s.tau_begin + part * (s.tau_end - s.tau_begin);
  const double end = lifetime(s.trajectory), left = end - s.tau_begin;
  return end - left * std::pow((end - s.tau_end) / left, part);
}

// What adds up from segment to segment.
struct Swept {
  double azimuth = 0, null_time = 0;

  void add(const OrbitPoint& from, const OrbitPoint& to) {
    azimuth += to.azimuth - from.azimuth;
    null_time += to.null_time - from.null_time;
  }
};

// By the segments before this one.
Swept swept_before(const Show& show, int segment) {
  Swept swept;
  for (int k = 0; k < segment; ++k) {
    const Segment& s = show.timeline[static_cast<std::size_t>(k)];
    swept.add(point_at(s.trajectory, s.tau_begin), point_at(s.trajectory, s.tau_end));
  }
  return swept;
}

}  // namespace

V3d motion_direction(const ObserverState& o) {
  // d/dt = T +- sqrt(2/r) R in rain or the outgoing tetrad, here seen from the observer's frame.
  const double s = std::sqrt(2 / o.r);
  const V3d killing(is_outgoing(o.tetrad) ? -s : s, 0, 0);
  const double gamma = std::sqrt(1 + o.celerity.dot(o.celerity));
  return -(killing - o.celerity * (1 - o.celerity.dot(killing) / (1 + gamma)));
}

std::optional<V3d> target_direction(const Attitude& attitude, const ObserverState& o) {
  if (std::holds_alternative<LookAtHole>(attitude))
    return to_observer(o.celerity, V3d(-1, 0, 0)).direction;
  if (std::holds_alternative<LookAlongMotion>(attitude)) return motion_direction(o).normalized();
  if (const auto* sky = std::get_if<LookAtSky>(&attitude)) {
    const V3d source = apply_transposed(o.sky_from_tetrad, sky->target.v);
    return to_observer(o.celerity, primary_image(o.r, o.tetrad, source).v).direction;
  }
  return std::nullopt;
}

M33d camera_axes(const Camera& camera, const Projection& projection,
                 const ObserverState& observer) {
  const auto target = target_direction(camera.attitude, observer);
  const bool dome = std::holds_alternative<Domemaster>(projection);
  if (!target) {
    const M33d axes = euler_axes(std::get<EulerAngles>(camera.attitude));
    return dome ? tilted(axes, camera.dome_tilt) : axes;
  }
  const V3d& f = *target;
  const V3d up = up_across(f, observer), right = f.cross(up);
  if (!dome) return rolled(right, -up, f, camera.roll);
  // Roll turns the scene about the target, so it comes before the target is set on the dome.
  const M33d screen = rolled(right, -up, f, camera.roll);
  const V3d x = column(screen, 0), u = -column(screen, 1);
  const double elevation = camera.elevation + camera.dome_tilt;
  const double c = std::cos(elevation), s = std::sin(elevation);
  return from_columns(x, f * c - u * s, f * s + u * c);
}

FrameState frame_state(const Show& show, int frame) {
  FrameState state;
  state.frame = frame;
  state.show_time_s = frame / show.frames_per_second;
  state.projection = show.projection;
  double begin = 0;
  const int last = static_cast<int>(show.timeline.size()) - 1;
  while (state.segment < last &&
         (frame + kCutTolerance) / show.frames_per_second >=
             begin + show.timeline[static_cast<std::size_t>(state.segment)].duration_s)
    begin += show.timeline[static_cast<std::size_t>(state.segment++)].duration_s;
  const Segment& segment = show.timeline[static_cast<std::size_t>(state.segment)];
  const double part = std::clamp((state.show_time_s - begin) / segment.duration_s, 0.0, 1.0);
  const double tau = proper_time_at(segment, part);
  const OrbitPoint start = point_at(segment.trajectory, segment.tau_begin);
  const OrbitPoint point = point_at(segment.trajectory, tau);

  ObserverState& o = state.observer;
  o.region = point.region;
  o.tetrad = point.tetrad;
  o.r = point.r;
  o.proper_time = tau;
  o.celerity = point.celerity;
  Swept swept = swept_before(show, state.segment);
  swept.add(start, point);
  o.null_time = swept.null_time;
  o.sky_from_tetrad = place_tetrad(show.hole_at, show.heading, swept.azimuth);
  o.tetrad_from_camera = camera_axes(segment.camera, show.projection, o);
  return state;
}

}  // namespace domefall
