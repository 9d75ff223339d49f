#include "pipeline/show/attitude.h"

#include <Imath/ImathQuat.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/light/lens_store.h"
#include "pipeline/show/curve.h"
#include "pipeline/show/viewer.h"

namespace domefall {
namespace {

// Returns the scene's "up" across the line of sight, which a target leaves free.  It is the north
// of the orbit, -Theta, or in flat space that of the sky.  For a target within 0.06 degrees of that
// axis it is outward, R.
V3d up_across(const V3d& target, const ObserverState& o) {
  const V3d north = is_flat(o) ? apply_transposed(o.sky_from_tetrad, V3d(0, 0, 1)) : V3d(0, -1, 0);
  const V3d outward = column(base_axes(o), 0);
  const V3d up = target.cross(north).length() > 1e-3 ? north : outward;
  return (up - target * up.dot(target)).normalized();
}

// Returns the camera axes after a turn by `angle` about z, so that the image, whose y points down,
// turns clockwise.
M33d rolled(const V3d& x, const V3d& y, const V3d& z, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return from_columns(x * c - y * s, y * c + x * s, z);
}

// Returns the axes after rotations by phi about C, vartheta about the new B and psi about the new
// C, where A, B and C are the boosted Theta, Phi and R.  [Riazuelo] sec. sec_cam.
M33d euler_axes(const EulerAngles& angle) {
  const V3d a(0, 1, 0), b(0, 0, 1), c(1, 0, 0);
  const V3d a1 = a * std::cos(angle.phi) + b * std::sin(angle.phi);
  const V3d b1 = b * std::cos(angle.phi) - a * std::sin(angle.phi);
  const V3d z = c * std::cos(angle.vartheta) + a1 * std::sin(angle.vartheta);
  const V3d a2 = a1 * std::cos(angle.vartheta) - c * std::sin(angle.vartheta);
  return from_columns(a2 * std::cos(angle.psi) + b1 * std::sin(angle.psi),
                      b1 * std::cos(angle.psi) - a2 * std::sin(angle.psi), z);
}

// Returns the axes of a dome that leans forward, so that what stood at elevation e in front stands
// at e + tilt.
M33d tilted(const M33d& axes, double tilt) {
  const V3d y = column(axes, 1), z = column(axes, 2);
  const double c = std::cos(tilt), s = std::sin(tilt);
  return from_columns(column(axes, 0), y * c - z * s, y * s + z * c);
}

// Returns the unit quaternion (w, v) of a rotation m.  The diagonal of m gives trace m + 1 = 4 w^2
// and 1 + m_ii - m_jj - m_kk = 4 v_i^2.  The root of the one or the other that is taken is at least
// 1/2, so that nothing cancels.  The other components follow from it, since m_kj - m_jk = 4 w v_i
// and m_ij + m_ji = 4 v_i v_j.
Imath::Quatd quaternion_of(const M33d& m) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) {
    const double w = std::sqrt(1 + trace) / 2;
    return {w, (m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w),
            (m[1][0] - m[0][1]) / (4 * w)};
  }
  int i = m[1][1] > m[0][0] ? 1 : 0;
  if (m[2][2] > m[i][i]) i = 2;
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  V3d v;
  v[i] = std::sqrt(1 + m[i][i] - m[j][j] - m[k][k]) / 2;
  v[j] = (m[i][j] + m[j][i]) / (4 * v[i]);
  v[k] = (m[i][k] + m[k][i]) / (4 * v[i]);
  return {(m[k][j] - m[j][k]) / (4 * v[i]), v.x, v.y, v.z};
}

// Returns motion_direction() in the frame whose directions are drawn.  Outside the horizon that
// frame may be at rest, and then the direction is that in which the observer moves against it.
// Inside, where the frame rests in t, motion_direction() of that frame continues it.
V3d motion_seen(const ObserverState& o, const Viewer& viewer) {
  if (!viewer.measured) return motion_direction(o);
  if (has_rest(o)) return *viewer.measured;
  ObserverState resting = o;
  resting.celerity = viewer.celerity;
  return motion_direction(resting);
}

// Returns the direction of the hole in the tetrad, or that of a wormhole's nearer mouth.  From one
// radius outside of the throat on, the latter turns around by way of Phi, so that it does not jump
// where an observer passes.
V3d hole_direction(const ObserverState& o) {
  const auto* wormhole = std::get_if<Wormhole>(&o.spacetime.kind());
  const double near = wormhole ? wormhole->half_length() + 1 : 0;
  if (o.l >= near) return {-1, 0, 0};
  if (o.l <= -near) return {1, 0, 0};
  const double angle = std::numbers::pi * smooth_step((near - o.l) / (2 * near));
  return {-std::cos(angle), 0, std::sin(angle)};
}

// Returns the observer's lens, without tables, which a camera needs none of.
std::shared_ptr<const Lens> aiming_lens(const ObserverState& o) {
  return LensStore().lens(o, {{false, false, false}});
}

// Returns the direction in the tetrad in which a body is seen, or that of the hole where the body
// is not seen or the observer rides it.
V3d direct_image(const Body& body, const ObserverState& o) {
  constexpr double kApart = 1e-6;  // M; rounding spoils directions to what is nearer
  const V3d hole(-1, 0, 0);
  if (!sees_bodies(o)) return hole;
  const auto image = aiming_lens(o)->body_image(
      o.null_time, motion_of(o.spacetime, body, o.sky_from_tetrad), 0, 0);
  return image && image->angle_per_length * kApart < 1 ? image->direction : hole;
}

}  // namespace

// This is the inverse of the rotations of euler_axes().  Z = (cos theta, cos phi sin theta,
// sin phi sin theta) in (R, Theta, Phi), and X is at the angle psi from what the first two
// rotations make of Theta.
EulerAngles euler_angles_of(const M33d& base_from_camera) {
  const V3d x = column(base_from_camera, 0), z = column(base_from_camera, 2);
  const double sine = std::hypot(z.y, z.z), theta = std::atan2(sine, z.x),
               phi = sine > 0 ? std::atan2(z.z, z.y) : 0;
  const V3d a1(0, std::cos(phi), std::sin(phi)), b1(0, -std::sin(phi), std::cos(phi));
  const V3d a2 = a1 * std::cos(theta) - V3d(1, 0, 0) * std::sin(theta);
  return {phi, theta, std::atan2(x.dot(b1), x.dot(a2))};
}

M33d base_axes(const ObserverState& observer) {
  const M33d tetrad;
  if (!observer.spacetime.is<ChargedHole>()) return tetrad;
  const V3d r(1, 0, 0), seen = to_observer(observer.celerity, r).direction -
                               to_observer(observer.celerity, -r).direction;
  const V3d axis = r.cross(seen);
  const double sine = axis.length();
  return sine > 0 ? turned_by(tetrad, axis * (std::atan2(sine, seen.x) / sine)) : tetrad;
}

M33d base_from_camera(const ObserverState& observer) {
  return base_axes(observer).transposed() * observer.tetrad_from_camera;
}

M33d untilted(const M33d& axes, double tilt) { return tilted(axes, -tilt); }

V3d motion_direction(const ObserverState& o) {
  // The boost into the observer's frame ([Riazuelo] eq. Lambda_cov) turns the spatial part k of
  // d/dt = t T + k into k - c (t - c.k/(1 + gamma)), where c = gamma v.
  const auto [along_t, killing] = static_time(o);
  const double gamma = gamma_of(o.celerity);
  return -(killing - o.celerity * (along_t - o.celerity.dot(killing) / (1 + gamma)));
}

std::optional<V3d> target_direction(const Attitude& attitude, const ObserverState& o,
                                    const Effects& effects) {
  const Viewer viewer = viewer_of(o, effects);
  const V3d hole = to_observer(viewer.celerity, hole_direction(o)).direction;
  if (std::holds_alternative<LookAtHole>(attitude)) return hole;
  if (std::holds_alternative<LookOutward>(attitude))
    return to_observer(viewer.celerity, V3d(0, 0, 0) - hole_direction(o)).direction;
  if (std::holds_alternative<LookAlongMotion>(attitude)) {
    const V3d motion = motion_seen(o, viewer);
    // What is left of the motion of an observer who has stopped is rounding.
    constexpr double kAtRest = 1e-14;
    return motion.length() > kAtRest * (1 + o.celerity.length2()) ? motion.normalized() : hole;
  }
  if (const auto* sky = std::get_if<LookAtSky>(&attitude)) {
    // From region IV no sky is seen.  At r = 2 its images appear in the outward direction.
    if (o.region == Region::kIV) return to_observer(viewer.celerity, V3d(1, 0, 0)).direction;
    const V3d source = apply_transposed(sky_axes(o, own_sky(o)), sky->target.v);
    const V3d image = effects.lensing ? aiming_lens(o)->primary_image(source)
                                      : to_tetrad(viewer.rest, source).direction;
    return to_observer(viewer.celerity, image).direction;
  }
  if (const auto* target = std::get_if<LookAtBody>(&attitude))
    return to_observer(viewer.celerity, direct_image(*target->body, o)).direction;
  return std::nullopt;
}

M33d camera_axes(const Camera& camera, const Projection& projection, const ObserverState& observer,
                 const Effects& effects) {
  const auto target = target_direction(camera.attitude, observer, effects);
  const bool dome = has_zenith(projection);
  if (!target) {
    const M33d axes = base_axes(observer) * euler_axes(std::get<EulerAngles>(camera.attitude));
    return dome ? tilted(axes, camera.dome_tilt) : axes;
  }
  const V3d& f = *target;
  const V3d up = up_across(f, observer), right = f.cross(up);
  if (!dome) return rolled(right, -up, f, camera.roll);
  // Roll turns the scene about the target, so it is applied before the target is put on the dome.
  const M33d screen = rolled(right, -up, f, camera.roll);
  const V3d x = column(screen, 0), u = -column(screen, 1);
  // The target f stands at the elevation e above the front Y, and the screen's up u is at right
  // angles to it: f = Y cos e + Z sin e and u = Z cos e - Y sin e, which are solved for Y and Z.
  const double elevation = camera.elevation + camera.dome_tilt;
  const double c = std::cos(elevation), s = std::sin(elevation);
  return from_columns(x, f * c - u * s, f * s + u * c);
}

M33d audience_axes(const Projection& projection, double dome_tilt) {
  if (!has_zenith(projection)) return from_columns({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
  // What stood at elevation e above the front stands at e + dome_tilt.
  const double c = std::cos(dome_tilt), s = std::sin(dome_tilt);
  return from_columns({1, 0, 0}, {0, c, s}, {0, -s, c});
}

V3d turn_between(const M33d& from, const M33d& to, const V3d& before) {
  // The inverse of a rotation is its transpose, so that this product leads from the one to the
  // other.
  const Imath::Quatd q = quaternion_of(to * from.transposed());
  // The quaternion of a rotation holds the cosine and the sine of half its angle.
  const double sine = q.v.length();
  const double angle = 2 * std::atan2(sine, q.r);
  // A rotation by no angle or by whole turns has no axis of its own, so that it keeps that of
  // `before`.
  const V3d axis = sine > 0 ? q.v / sine : before.normalized();
  const double turns = std::round((before.dot(axis) - angle) / (2 * std::numbers::pi));
  return axis * (angle + 2 * std::numbers::pi * turns);
}

M33d turned_by(const M33d& from, const V3d& turn) {
  const double angle = turn.length();
  if (!(angle > 0)) return from;
  const V3d n = turn / angle;
  const double c = std::cos(angle), s = std::sin(angle);
  // Rodrigues' formula rotates v about n by the angle.
  const auto rotated = [&](const V3d& v) {
    return v * c + n.cross(v) * s + n * (n.dot(v) * (1 - c));
  };
  return from_columns(rotated(column(from, 0)), rotated(column(from, 1)), rotated(column(from, 2)));
}

}  // namespace domefall
