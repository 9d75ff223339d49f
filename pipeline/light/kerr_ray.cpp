#include "pipeline/light/kerr_ray.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/light/kerr_path.h"
#include "pipeline/light/kerr_sphere.h"

namespace domefall {
namespace {

template <class T>
void follow_to_sky(const KerrStart& start, const KerrRoots& roots, double ratio, TracedKerr& out) {
  const KerrPath<T> path(start, roots);
  const typename KerrPath<T>::Sum whole = path.whole();
  KerrSphere<T> sphere = kerr_sphere_of<T>(start);
  sphere.follow(whole.mino);
  out.mino = value(whole.mino) / std::abs(out.energy);
  out.turns = sphere.turns;
  if (value(sphere.half_turn) > 0) out.swept = M_PI * value(whole.mino) / value(sphere.half_turn);
  const V3d n(value(sphere.place[0]), value(sphere.place[1]), value(sphere.place[2]));
  double angle = value(whole.angle);
  if (start.mirrored) angle = -angle - static_cast<double>(2 * start.at.hole.twist(start.at.r));
  const double c = std::cos(angle), s = std::sin(angle), y = start.mirrored ? -n.y : n.y;
  out.undragged = V3d(n.x, y, n.z), out.dragged = angle;
  out.sky = V3d(n.x * c - y * s, n.x * s + y * c, n.z);
  if constexpr (std::is_same_v<T, Dual>) {
    const V3d about(-n.y, n.x, 0);
    const auto change = [&](double Dual::*by) {
      const V3d own(sphere.place[0].*by, sphere.place[1].*by, sphere.place[2].*by);
      return own + about * (whole.angle.*by);
    };
    const V3d by_delta = change(&Dual::d), along_edge = change(&Dual::e);
    out.amplification = 1 / std::abs(n.dot(by_delta.cross(along_edge)));
    // On the sky, with the mirror image undone.
    const auto placed = [&](const V3d& v) {
      const double w = start.mirrored ? -v.y : v.y;
      return V3d(v.x * c - w * s, v.x * s + w * c, v.z);
    };
    out.by_delta = placed(by_delta);
    out.across = placed(along_edge - by_delta * ratio) * (start.mirrored ? -1 : 1);
  }
}

// Takes as the second direction, instead of that of eta, nearly the one along the edge, and returns how
// much of delta it then has.  Next to an edge the sky changes much and alike in any other two.
double turn_along_edge(KerrStart& start, KerrRoots& roots) {
  const auto change = [&](long double Scaled::*by) {
    return 2 * roots.b1.v * (roots.b1.*by) - 4 * (roots.b0.*by);
  };
  constexpr long double kMost = 10;
  const long double ratio =
      std::clamp(-change(&Scaled::by_eta) / change(&Scaled::by_delta), -kMost, kMost);
  if (!(std::abs(ratio) <= kMost)) return 0;
  for (Scaled* s : {&start.kappa, &start.mu, &start.speed, &start.polar, &start.azimuthal,
                    &roots.b1, &roots.b0, &roots.e1, &roots.e0})
    s->by_eta += ratio * s->by_delta;
  return static_cast<double>(ratio);
}

template <class T>
TracedKerr trace_with(const KerrPlace& at, const KerrDirection& direction) {
  KerrStart start = kerr_start(at, direction);
  TracedKerr out{};
  out.origin = start.origin;
  out.energy = static_cast<double>(start.energy);
  if (start.origin == KerrOrigin::kPastHorizon) return out;
  KerrRoots roots = kerr_roots(start);
  const double ratio = std::is_same_v<T, Dual> ? turn_along_edge(start, roots) : 0;
  follow_to_sky<T>(start, roots, ratio, out);
  return out;
}

}  // namespace

TracedKerr trace_kerr(const KerrPlace& at, const KerrDirection& direction) {
  return trace_with<Dual>(at, direction);
}

TracedKerr trace_kerr_without_area(const KerrPlace& at, const KerrDirection& direction) {
  return trace_with<double>(at, direction);
}

std::vector<KerrPassage> kerr_passages(const KerrPlace& at, const KerrDirection& direction,
                                       std::size_t most) {
  const KerrStart start = kerr_start(at, direction);
  const KerrPath<double> path(start, kerr_roots(start));
  KerrSphere<double> sphere = kerr_sphere_of<double>(start);
  const double whole = path.mino_between(path.first(), path.last());
  sphere.follow(whole, true);
  const double sign = start.mirrored ? -1 : 1, energy = static_cast<double>(start.energy);
  const auto a = static_cast<double>(at.hole.spin), sine = static_cast<double>(std::sin(at.theta));
  const double side = static_cast<double>(start.mu.v) + sign * a * a * sine * sine;  // aL/|E|
  std::vector<KerrPassage> passages;
  double y = path.first(), mino = 0;
  KerrPath<double>::Sum sum;
  for (const auto& crossing : sphere.crossings) {
    if (passages.size() == most) break;
    const double before = y;
    path.move_to(crossing.mino, y, mino);
    if (y >= path.last()) break;  // on the past horizon, to the last digit
    const KerrPath<double>::Sum more = path.between(before, y, sign);
    sum.angle += more.angle, sum.time += more.time;
    const auto place = path.place(y);
    const double across = sign * std::atan2(crossing.place[1], crossing.place[0]);
    KerrPassage passage{};
    passage.r = place.r;
    passage.outgoing = place.speed > 0;
    passage.speed = place.speed / (place.r * place.r);
    passage.phi = std::remainder(sum.angle + across, 2 * M_PI);
    passage.null_time =
        sum.time - side * crossing.mino + sign * a * a * (crossing.mino - crossing.squares);
    passage.mino = crossing.mino;
    passage.energy = energy;
    const auto y_term = static_cast<double>(start.kappa.v * std::sin(direction.eta));
    passage.angular_momentum = std::abs(energy) * sine * (y_term + sign * a * sine);
    passages.push_back(passage);
  }
  return passages;
}

std::optional<double> circling_shift(const KerrHole& hole, const KerrPassage& at, bool prograde) {
  const std::optional<KerrCircle> circle = kerr_circle(hole, at.r, prograde);
  if (!circle) return std::nullopt;
  return std::abs(circle->time * at.energy - circle->angle * at.angular_momentum);
}

}  // namespace domefall
