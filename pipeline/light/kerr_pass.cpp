#include "pipeline/light/kerr_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/kerr_view.h"

namespace domefall {
namespace {

// Returns a vector in the frame of who moves with u, whose axes are boosted.
TetradVector boosted(const TetradVector& u, const TetradVector& x) {
  const double along = u.s.dot(x.s);
  return {u.t * x.t - along, x.s + u.s * (along / (u.t + 1) - x.t)};
}

}  // namespace

V3d turned_view(const KerrPass& pass, const KerrPlace& at, const Turn& turn, double part) {
  constexpr double kMost = 0.2, kMostOfDistance = 0.5, kWound = 2.5, kSmall = 1e-4;
  const KerrDirection n = kerr_direction_of(pass.view);
  const auto delta = static_cast<double>(n.delta), eta = static_cast<double>(n.eta);
  part *= std::min(1.0, kMost / std::hypot(turn.by_delta, turn.across));
  const double x = part * turn.by_delta, y = part * turn.across;
  const ViewAxes axes(delta, eta);
  if (pass.event.swept < kWound)
    return (pass.view + axes.by_delta * x + axes.across * y).normalized();
  const double by_eta = y / std::sin(delta), from_edge = delta - kerr_edge_delta(at, eta),
               slope = (kerr_edge_delta(at, eta + kSmall) - kerr_edge_delta(at, eta - kSmall)) /
                       (2 * kSmall),
               most = kMostOfDistance * std::abs(from_edge),
               away = std::clamp(x - slope * by_eta, -most, most);
  return kerr_view(kerr_edge_delta(at, eta + by_eta) + from_edge + away, eta + by_eta);
}

KerrBodyRays::KerrBodyRays(const KerrPlace& at, double null_time, const BodyMotion& motion)
    : at_(at), null_time_(null_time), motion_(motion) {
  const auto theta = static_cast<double>(at.theta);
  axes_ = kerr_axes({std::sin(theta), 0, std::cos(theta)});
}

std::optional<KerrBodyPoint> KerrBodyRays::body(double tau) const {
  if (!(tau > motion_.begin && tau < motion_.end)) return std::nullopt;
  const BodyPoint point = motion_.at(tau);
  if (!(point.r > 0)) return std::nullopt;
  const V3d place = apply(axes_, point.direction);
  const V3d celerity = apply_transposed(kerr_axes(place), apply(axes_, point.celerity()));
  return KerrBodyPoint{{point.r, place}, point.null_time, {point.gamma, celerity}};
}

std::optional<KerrPass> KerrBodyRays::pass(const V3d& view, double mino, double tau) const {
  const auto event = kerr_event(at_, kerr_direction_of(view), mino);
  const auto there = event ? body(tau) : std::nullopt;
  if (!there) return std::nullopt;
  const TetradVector& u = there->velocity;
  // Both are told along axes of their own, which turn fast next to the hole's axis.
  const M33d own = kerr_axes(there->at.place), theirs = kerr_axes(event->at.place);
  const auto in_body = [&](const TetradVector& x) {
    return boosted(u, {x.t, apply_transposed(own, apply(theirs, x.s))});
  };
  // Along a straight line in r and the place, as it is far from the hole.
  const double r = there->at.r;
  const V3d way = there->at.place * r - event->at.place * event->at.r;
  const double by_r = way.dot(there->at.place),
               later = there->null_time - null_time_ - event->null_time;
  const TetradVector light = in_body(event->light), by_delta = in_body(event->by_delta),
                     across = in_body(event->across),
                     apart = boosted(u, tetrad_vector(at_.hole, there->at, by_r, way / r,
                                                      later - (r - event->at.r) + by_r));
  const V3d k = light.s / light.t;
  KerrPass pass{};
  pass.view = view, pass.mino = mino, pass.tau = tau;
  pass.event = *event, pass.body = *there;
  pass.frequency = event->energy * light.t;
  pass.leaving = k;
  const double along = k.dot(apart.s);
  pass.late = along - apart.t;
  pass.off = apart.s - k * along;
  pass.by_delta = by_delta.s - k * by_delta.t;
  pass.across = across.s - k * across.t;
  const double per_time = 1 / (event->sigma * light.t);
  pass.ahead = -along * per_time;
  pass.ahead_by_delta = event->mino_by_delta + by_delta.t * per_time;
  pass.ahead_across = event->mino_across + across.t * per_time;
  return pass;
}

std::optional<KerrPass> KerrBodyRays::nearest(const V3d& view, double mino, double tau) const {
  constexpr int kMost = 32;  // at a large body a step leaves a fourth of the way
  constexpr double kEnough = 1e-7;
  std::optional<KerrPass> found;
  for (int i = 0; i < kMost; ++i) {
    found = pass(view, mino, tau);
    if (!found) return std::nullopt;
    mino = std::max(mino / 4, mino + found->ahead), tau += found->late;
    if (std::abs(found->late) < kEnough * found->body.at.r) return found;
  }
  return std::nullopt;
}

std::optional<KerrPass> KerrBodyRays::meet(const V3d& view, double mino, double tau) const {
  constexpr int kMost = 16, kHalvings = 6;
  constexpr double kEnough = 1e-10;
  std::optional<KerrPass> at = pass(view, mino, tau);
  for (int i = 0; i < kMost && at; ++i) {
    const double left = at->off.length() + std::abs(at->late);
    if (!std::isfinite(left)) return std::nullopt;
    if (left <= kEnough * at->body.at.r) return at;
    const V3d &d = at->by_delta, &e = at->across;
    const double dd = d.dot(d), ee = e.dot(e), de = d.dot(e), det = dd * ee - de * de;
    if (!(det > 0)) return std::nullopt;
    const double x = (at->off.dot(d) * ee - at->off.dot(e) * de) / det,
                 y = (at->off.dot(e) * dd - at->off.dot(d) * de) / det;
    const double ahead = at->ahead + at->ahead_by_delta * x + at->ahead_across * y;
    std::optional<KerrPass> next;
    double part = 1;
    for (int k = 0; k < kHalvings && !next; ++k, part /= 2)
      next = pass(turned_view(*at, at_, {x, y}, part),
                  std::max(at->mino / 4, at->mino + ahead * part), at->tau + at->late * part);
    at = next;
  }
  return std::nullopt;
}

KerrStretch kerr_stretch(const KerrPass& pass) {
  const V3d &d = pass.by_delta, &e = pass.across;
  const double angle = std::atan2(2 * d.dot(e), d.dot(d) - e.dot(e)) / 2, c = std::cos(angle),
               s = std::sin(angle);
  const KerrDirection n = kerr_direction_of(pass.view);
  const ViewAxes view(static_cast<double>(n.delta), static_cast<double>(n.eta));
  const V3d longest = d * c + e * s, other = e * c - d * s;
  KerrStretch out;
  out.longer = longest.length(), out.shorter = other.length();
  out.along = out.longer > 0 ? longest / out.longer : V3d(0, 0, 0);
  out.across = pass.leaving.cross(out.along);
  if (out.across.dot(other) < 0) out.across = -out.across;
  out.longer_view = view.by_delta * c + view.across * s;
  out.shorter_view = view.across * c - view.by_delta * s;
  return out;
}

}  // namespace domefall
