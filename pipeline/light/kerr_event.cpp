#include "pipeline/light/kerr_event.h"

#include <cmath>

#include "pipeline/light/kerr_path.h"
#include "pipeline/light/kerr_sphere.h"

namespace domefall {
namespace {

V3d vector_of(const std::array<Dual, 3>& n, double Dual::*part, double side) {
  return {n[0].*part, side * (n[1].*part), n[2].*part};
}

// The photon over |E|, of which N' is that of light followed back.
TetradVector light_of(const KerrPlace& at, const KerrStart& start, const KerrSpot& spot,
                      double speed, const V3d& n_back, double sign) {
  const auto a = static_cast<double>(at.hole.spin), r = spot.r;
  const auto kappa = static_cast<double>(start.kappa.v);
  const double cosine = spot.place.z, sigma = r * r + a * a * cosine * cosine,
               size = std::sqrt(sigma), sine = std::hypot(spot.place.x, spot.place.y);
  const double p = sign * (r * r + static_cast<double>(at.sigma() - start.mu.v));
  const double along = (p > 0) != (speed > 0) ? kappa * kappa / (p - speed)
                                              : (p + speed) / static_cast<double>(at.hole.delta(r));
  const double b = (p - speed) / (2 * sigma);
  const M33d axes = kerr_axes(spot.place);
  return {along / 2 + b,
          {along / 2 - b, -n_back.dot(column(axes, 1)) / size,
           (-n_back.dot(column(axes, 2)) - sign * a * sine) / size}};
}

}  // namespace

M33d kerr_axes(const V3d& place) {
  const double sine = std::hypot(place.x, place.y);
  const V3d round = sine > 0 ? V3d(-place.y, place.x, 0) / sine : V3d(0, 1, 0);
  return from_columns(place, round.cross(place), round);
}

TetradVector tetrad_vector(const KerrHole& hole, const KerrSpot& at, double by_r,
                           const V3d& by_place, double by_v) {
  const auto a = static_cast<double>(hole.spin), r = at.r;
  const double sine = std::hypot(at.place.x, at.place.y),
               size = std::sqrt(r * r + a * a * at.place.z * at.place.z);
  const M33d axes = kerr_axes(at.place);
  const double around = by_place.dot(column(axes, 2));  // sin(theta) dphi
  const double along = by_v - a * sine * around;        // of l
  const double inward = along * static_cast<double>(hole.delta(r)) / (2 * size * size) - by_r;
  return {along / 2 + inward,
          {along / 2 - inward, size * by_place.dot(column(axes, 1)),
           ((r * r + a * a) * around - a * sine * by_v) / size}};
}

double null_time_along(const KerrHole& hole, const KerrSpot& at, const TetradVector& vector) {
  const auto a = static_cast<double>(hole.spin), r = at.r;
  const double sine = std::hypot(at.place.x, at.place.y),
               sigma = r * r + a * a * at.place.z * at.place.z;
  return (vector.t + vector.s.x) * (r * r + a * a) / sigma +
         vector.s.z * a * sine / std::sqrt(sigma);
}

std::optional<KerrEvent> kerr_event(const KerrPlace& at, const KerrDirection& direction,
                                    double mino) {
  const KerrStart start = kerr_start(at, direction);
  const KerrPath<Dual> path(start, kerr_roots(start));
  const double sign = start.mirrored ? -1 : 1;
  double y = path.first(), done = 0;
  path.move_to(mino, y, done);
  const double r = path.place(y).r;
  const auto horizon = static_cast<double>(at.hole.horizon());
  if (!(std::abs(done - mino) <= 1e-9 * mino) || !(r > 0) || (start.mirrored && r >= horizon))
    return std::nullopt;
  const KerrPath<Dual>::Sum sum = path.up_to(y, sign);
  KerrSphere<Dual> sphere = kerr_sphere_of<Dual>(start);
  sphere.follow(sum.mino.v, true);
  const auto a = static_cast<double>(at.hole.spin);
  const double c = std::cos(sum.angle.v), s = std::sin(sum.angle.v);
  const auto turned = [&](const V3d& v) { return V3d(v.x * c - v.y * s, v.x * s + v.y * c, v.z); };
  KerrEvent event{};
  event.at = {r, turned(vector_of(sphere.place, &Dual::v, sign))};
  event.energy = static_cast<double>(std::abs(start.energy));
  event.sigma = r * r + a * a * event.at.place.z * event.at.place.z;
  event.swept = static_cast<double>(start.kappa.v) * sum.mino.v;
  const V3d n_back = turned(vector_of(sphere.speed, &Dual::v, sign));
  event.light = light_of(at, start, event.at, path.place(y).speed, n_back, sign);
  const auto sine = static_cast<double>(std::sin(at.theta));
  const double side = static_cast<double>(start.mu.v) + sign * a * a * sine * sine;  // aL/|E|
  event.null_time = sum.time.v - side * sum.mino.v + sign * a * a * (sum.mino.v - sphere.squares);
  // v follows from the others, since light stays on the cone.
  const TetradVector of_v = tetrad_vector(at.hole, event.at, 0, {0, 0, 0}, 1);
  const V3d& n = event.at.place;
  const Dual w = path.inverse_radius(y);
  const auto moved = [&](double Dual::*by) {
    const V3d by_place = turned(vector_of(sphere.place, by, sign)) + n_back * (sum.mino.*by) +
                         V3d(-n.y, n.x, 0) * (sum.angle.*by);
    const TetradVector step = tetrad_vector(at.hole, event.at, -r * r * (w.*by), by_place, 0);
    return step + of_v * (-event.light.dot(step) / event.light.dot(of_v));
  };
  event.by_delta = moved(&Dual::d);
  event.across = moved(&Dual::e) * sign;
  event.mino_by_delta = sum.mino.d, event.mino_across = sum.mino.e * sign;
  return event;
}

}  // namespace domefall
