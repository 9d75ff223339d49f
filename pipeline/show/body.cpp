#include "pipeline/show/body.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/emission_time.h"
#include "pipeline/show/placement.h"

namespace domefall {
namespace {

// Brings a point of region I from the outgoing tetrad to rain.  All other points stay as they are.
// The null times differ by v - u = 2 r*.
OrbitPoint in_rain(const Spacetime& spacetime, OrbitPoint point) {
  if (!is_outgoing(point.tetrad) || point.region != Region::kI) return point;
  point.celerity =
      Celerity<ReferenceTetrad>(rain_celerity(spacetime, point.r, point.tetrad, point.celerity));
  point.null_time = point.null_time + 2 * spacetime.tortoise(point.r);
  point.tetrad = Tetrad::kRain;
  return point;
}

// Returns the proper time since Body::start at which a body begins to shine.
double first_proper_time(const Body& body) {
  return body.shines_before ? birth(body.trajectory) - double(body.start) : 0;
}
// Returns the proper time since Body::start at which a body ends, or goes through the inner horizon
// of a charge, beyond which it is not seen.
double last_proper_time(const Spacetime& spacetime, const Body& body) {
  double end = lifetime(body.trajectory);
  if (const auto* hole = std::get_if<ChargedHole>(&spacetime.kind()))
    if (const auto inner =
            time_at(body.trajectory, hole->inner_horizon(), Leg::kInward, body.start))
      end = std::min(end, double(*inner));
  return end - double(body.start);
}

// Returns R, Theta and Phi of a body about a hole that spins, whose axis is `normal`.
M33d axes_about_spin(const Body& body, const OrbitPoint& start, const OrbitPoint& now) {
  const V3d &axis = body.normal.v, &node = body.node.v;
  const double phi = body.azimuth + (now.azimuth - start.azimuth);
  const V3d out = node * std::cos(phi) + axis.cross(node) * std::sin(phi);
  const double sine = std::sin(now.theta), cosine = std::cos(now.theta);
  return from_columns(out * sine + axis * cosine, out * cosine - axis * sine, axis.cross(out));
}

BodyMotion motion_about_spin(const Body& body, const M33d& sky_from_tetrad) {
  const auto point = [&body](double tau) { return point_at(body.trajectory, body.start + tau); };
  const OrbitPoint start = point(0);
  const auto [low, high] = reach(body.trajectory);
  return {[=](double tau) {
            const OrbitPoint now = point(tau);
            const M33d axes = axes_about_spin(body, start, now);
            const V3d place = apply_transposed(sky_from_tetrad, column(axes, 0)),
                      across =
                          apply_transposed(sky_from_tetrad, column(axes, 1) * now.celerity.y +
                                                                column(axes, 2) * now.celerity.z);
            return BodyPoint{place,
                             now.r,
                             body.null_time + double(now.null_time - start.null_time),
                             gamma_of(now.celerity),
                             now.celerity.x,
                             place.cross(across) * now.r};
          },
          first_proper_time(body),
          lifetime(body.trajectory) - double(body.start),
          {},
          low,
          high};
}

}  // namespace

M33d own_axes(const Body& body) {
  const V3d &node = body.node.v, &normal = body.normal.v;
  const double c = std::cos(body.tilt), s = std::sin(body.tilt);
  return from_columns(node * c - normal * s, normal.cross(node), normal * c + node * s);
}

bool sees_bodies(const ObserverState& observer) {
  return !is_flat(observer) && !is_mirrored(observer.tetrad) && observer.region != Region::kIV;
}

BodyMotion motion_of(const Spacetime& spacetime, const Body& body, const M33d& sky_from_tetrad) {
  if (spacetime.is<SpinningHole>()) return motion_about_spin(body, sky_from_tetrad);
  const V3d normal = apply_transposed(sky_from_tetrad, body.normal.v);
  const V3d node = apply_transposed(sky_from_tetrad, body.node.v);
  const V3d onward = normal.cross(node);
  const auto point = [spacetime, &body](double tau) {
    return in_rain(spacetime,
                   placed(point_at(body.trajectory, body.start + tau), {false, body.backward, 0}));
  };
  const OrbitPoint start = point(0);
  return {[=](double tau) {
            const OrbitPoint now = point(tau);
            // The radius 0 of a BodyPoint without values stands for a body that is not there yet.
            // Near a charge it may come from a universe before.
            if (now.region == Region::kIV || now.region == Region::kV || now.universe != 0)
              return BodyPoint{};
            const double phi = body.azimuth + (now.azimuth - start.azimuth);
            return BodyPoint{node * std::cos(phi) + onward * std::sin(phi),
                             now.r,
                             body.null_time + double(now.null_time - start.null_time),
                             gamma_of(now.celerity),
                             now.celerity.x,
                             normal * (now.r * now.celerity.z),
                             now.l};
          },
          first_proper_time(body), last_proper_time(spacetime, body)};
}

Beginning beginning_beside(const Spacetime& spacetime, const Body& body, double tau,
                           double behind) {
  const BodyPoint at = motion_of(spacetime, body, M33d()).at(tau);
  const OrbitPoint own = point_at(body.trajectory, body.start + tau);
  if (spacetime.is<SpinningHole>())
    return {axes_about_spin(body, point_at(body.trajectory, body.start), own),
            at.null_time + behind};
  // The outgoing tetrad counts u = v - 2 r*.
  const bool outgoing = is_outgoing(own.tetrad) && own.region == Region::kI;
  return {from_columns(at.direction, -body.normal.v, body.normal.v.cross(at.direction)),
          at.null_time + behind - (outgoing ? 2 * spacetime.tortoise(own.r) : 0)};
}

// v grows with tau, so that steps that double bracket the tau, and bisection narrows the bracket
// down to two neighbouring doubles.
std::optional<double> time_of_null(const Spacetime& spacetime, const Body& body, double null_time) {
  const BodyMotion motion = motion_of(spacetime, body, M33d());
  const auto is_later = [&](double tau) { return motion.at(tau).null_time > null_time; };
  constexpr double kFarthestTau = 1e15, kFirstStep = 1e-3;  // M
  double low = 0, high = 0;
  for (double step = kFirstStep; is_later(low); step *= 2) {
    if (low <= motion.begin || low < -kFarthestTau) return std::nullopt;
    high = low;
    low = std::max(low - step, motion.begin);
  }
  for (double step = kFirstStep; !is_later(high); step *= 2) {
    if (high > kFarthestTau) return std::nullopt;
    // The motion has no point at its end, so that the steps towards it are halved.
    const double next = high + step;
    if (next >= motion.end && motion.end - high <= std::abs(motion.end) * 1e-15)
      return std::nullopt;
    high = next < motion.end ? next : high + (motion.end - high) / 2;
  }
  for (double middle = (low + high) / 2; low < middle && middle < high; middle = (low + high) / 2)
    (is_later(middle) ? high : low) = middle;
  return low;
}

}  // namespace domefall
