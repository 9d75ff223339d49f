#include "trajectories/kerr_radius.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace domefall {
namespace {

// How close to the horizons r is followed.
constexpr double kPastHorizon = 1e-6, kInnerHorizon = 1e-6;

}  // namespace

KerrRadius::KerrRadius(const KerrHole& hole, const KerrMotion& motion, double r, double speed)
    : hole_(hole),
      spin_(static_cast<double>(hole.spin)),
      energy_(motion.energy),
      excess_(motion.excess),
      carter_(motion.carter),
      charges_(static_cast<double>(hole.squares())),
      constant_(spin_ * (spin_ * energy_ - motion.momentum)),
      least_(r),
      greatest_(r) {
  follow({0, r, speed_at(r, speed)});
  if (circles_) return;
  series_.reserve(nodes_.size());
  for (const Node& node : nodes_) series_.push_back(series(node));
}

KerrRadius::NodeSeries KerrRadius::series_of(const Node& node) const {
  return series_.empty() ? series(node) : series_[static_cast<std::size_t>(&node - nodes_.data())];
}

KerrRadius::NodeSeries KerrRadius::series(const Node& at) const {
  NodeSeries s{};
  Series cube{}, p{}, delta{};
  // The terms of fast and of far ways would overflow without a unit.
  s.unit = 1 / (1 + std::abs(energy_) * at.r + std::sqrt(std::abs(carter_)));
  const double unit = s.unit;
  s.r[0] = at.r, s.r[1] = at.speed * unit;
  const bool falls = at.speed <= 0;
  for (int n = 0; n < kTerms; ++n) {
    const auto j = static_cast<std::size_t>(n);
    s.square[j] = product(s.r, s.r, n);
    cube[j] = product(s.square, s.r, n);
    const double bent = 2 * excess_ * cube[j] + 3 * s.square[j] +
                        (2 * energy_ * constant_ - charges_ - carter_) * s.r[j] +
                        (n == 0 ? carter_ : 0);
    s.r[j + 2] = unit * unit * bent / ((n + 1) * (n + 2));
    p[j] = energy_ * s.square[j] + (n == 0 ? constant_ : 0);
    const double speed = (n + 1) * s.r[j + 1] / unit;
    // The numerator less what the terms before have of it, over the first term of the denominator.
    delta[j] = falls ? p[j] - speed : s.square[j] - 2 * s.r[j] + (n == 0 ? charges_ : 0);
    double rest = falls ? s.square[j] + (n == 0 ? carter_ : 0) : p[j] + speed;
    if (n == 0 && !falls) delta[0] = static_cast<double>(hole_.delta(at.r));
    for (int m = 1; m <= n; ++m)
      rest -= delta[static_cast<std::size_t>(m)] * s.along[static_cast<std::size_t>(n - m)];
    s.along[j] = rest / delta[0];
  }
  for (int n = 0; n < kTerms; ++n)
    s.time[static_cast<std::size_t>(n)] =
        product(s.square, s.along, n) + spin_ * spin_ * s.along[static_cast<std::size_t>(n)];
  s.reach = unit * std::min({range(s.r, at.r), range(s.along, std::abs(s.along[0])),
                             range(s.time, std::abs(s.time[0]))});
  return s;
}

double KerrRadius::speed_at(double r, double nearly) const {
  const double linear = 2 * energy_ * constant_ - charges_ - carter_,
               rest = constant_ * constant_ - charges_ * carter_;
  const double square = (((excess_ * r + 2) * r + linear) * r + 2 * carter_) * r + rest;
  const double terms =
      (((std::abs(excess_) * r + 2) * r + std::abs(linear)) * r + 2 * std::abs(carter_)) * r +
      std::abs(rest);
  return square > 1e-2 * terms && nearly != 0 ? std::copysign(std::sqrt(square), nearly) : nearly;
}

KerrRadius::Node KerrRadius::after(const Node& at, const NodeSeries& s, double h) const {
  const double r = s.radius(h);
  return {at.l + h,
          r,
          speed_at(r, s.speed(h)),
          at.squares + s.unit * integral(s.square, h / s.unit),
          at.time + s.unit * integral(s.time, h / s.unit),
          at.angle + s.unit * integral(s.along, h / s.unit)};
}

void KerrRadius::follow(const Node& start) {
  NodeSeries s = series(start);
  const double bent = std::abs(s.r[2] / (s.unit * s.unit)),
               terms = std::abs(2 * excess_ * std::pow(start.r, 3)) + 3 * start.r * start.r +
                       std::abs(carter_);
  // How much steeper the pull becomes outwards, by r.
  const double stiff = -(6 * excess_ * start.r * start.r + 6 * start.r + 2 * energy_ * constant_ -
                         charges_ - carter_);
  circles_ = start.speed == 0 &&
             (bent < 1e-12 * terms || (stiff > 0 && 2 * bent / stiff < 1e-12 * start.r));
  nodes_.push_back(start);
  if (circles_) return;
  const double inner = static_cast<double>(hole_.inner_horizon()) + kInnerHorizon;
  std::vector<DoubleDouble> turns;
  Node now = start;
  if (start.speed == 0) turns.emplace_back(0);
  while (turns.size() < 3) {
    const double h = std::min(s.reach, 1e3);
    Node next = after(now, s, h);
    if (next.r < inner || !(next.r < kFarthest)) {
      const double bound = next.r < inner ? inner : kFarthest;
      const double x = zero_between([&](double t) { return s.radius(t) - bound; }, 0, h);
      ends_ = next.r < inner;
      nodes_.push_back(after(now, s, x));
      last_ = now.l + x;
      (ends_ ? least_ : greatest_) = bound;
      break;
    }
    const bool turned = now.speed != 0 && (now.speed > 0) != (next.speed > 0);
    if (turned) turns.push_back(now.l + zero_between([&](double t) { return s.speed(t); }, 0, h));
    nodes_.push_back(next);
    now = next;
    if (!turned || turns.size() < 3) s = series(now);
    if (nodes_.size() > 100000)
      throw std::domain_error("r cannot be followed that near to a bound");
  }
  for (const DoubleDouble& turn : turns) {
    const double r = at(turn).r;
    least_ = std::min(least_, r), greatest_ = std::max(greatest_, r);
  }
  if (turns.size() == 3) {
    const auto period = double(turns[2] - turns[0]);
    sums_ = at(period);
    period_ = period;
    return;
  }
  follow_back(start);
}

void KerrRadius::follow_back(const Node& start) {
  const double horizon = static_cast<double>(hole_.horizon()) + kPastHorizon;
  std::vector<Node> before;
  Node now = start;
  if (now.speed > 0 && now.r < horizon)
    throw std::domain_error("r must be farther from the past horizon");
  while (true) {
    const NodeSeries s = series(now);
    const double h = std::min(s.reach, 1e3);
    Node next = after(now, s, -h);
    greatest_ = std::max(greatest_, std::min(next.r, kFarthest));
    const bool out = next.speed > 0 && next.r < horizon, far = !(next.r < kFarthest);
    if (out || far) {
      const double bound = out ? horizon : kFarthest;
      double x = h;
      if ((now.r > bound) != (next.r > bound))
        x = zero_between([&](double t) { return s.radius(-t) - bound; }, 0, h);
      before.push_back(after(now, s, -x));
      first_ = now.l - x;
      comes_out_ = out;
      break;
    }
    before.push_back(next);
    now = next;
    if (before.size() > 100000)
      throw std::domain_error("r cannot be followed that near to a bound");
  }
  nodes_.insert(nodes_.begin(), before.rbegin(), before.rend());
}

KerrRadius::Node KerrRadius::at(const DoubleDouble& l) const {
  if (circles_) {
    const Node& node = nodes_.front();
    const auto passed = double(l);
    const double p = energy_ * node.r * node.r + constant_,
                 along = along_falling(hole_, node.r, p, 0, carter_);
    return {l,
            node.r,
            0,
            node.r * node.r * passed,
            (node.r * node.r + spin_ * spin_) * along * passed,
            along * passed};
  }
  const double periods = has_period() ? std::floor(double(l) / period_) : 0;
  const DoubleDouble rest = periods != 0 ? l - periods * period_ : l;
  const Node& node = node_before(nodes_, rest);
  Node there = after(node, series_of(node), double(rest - node.l));
  there.l = l;
  if (periods != 0) {
    there.squares = there.squares + periods * double(sums_.squares);
    there.time = there.time + periods * double(sums_.time);
    there.angle += periods * sums_.angle;
  }
  return there;
}

std::optional<DoubleDouble> KerrRadius::first_after(DoubleDouble l,
                                                    const DoubleDouble& after_l) const {
  if (!has_period()) return l >= after_l ? std::optional(l) : std::nullopt;
  // The instant itself comes back rounded.
  const double periods = double(after_l - l) / period_ - 1e-12;
  if (std::isfinite(periods)) l = l + period_ * std::ceil(periods);
  return std::max(l, after_l);
}

std::optional<DoubleDouble> KerrRadius::passage(double r, bool outward,
                                                const DoubleDouble& after_l) const {
  constexpr double kRounding = 1e-12;
  std::optional<DoubleDouble> found;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    const Node &from = nodes_[k], &to = nodes_[k + 1];
    const NodeSeries s = series_of(from);
    // A turn between two nodes divides their way.
    const auto end = double(to.l - from.l);
    const double turn = (from.speed > 0) != (to.speed > 0)
                            ? zero_between([&](double x) { return s.speed(x); }, 0, end)
                            : end;
    for (const auto& [a, b] : {std::pair(0.0, turn), std::pair(turn, end)}) {
      const double low = s.radius(a), high = s.radius(b);
      if (!(b > a) || (high > low) != outward) continue;
      // An end of an orbit is known to rounding.
      const double passed = std::clamp(r, std::min(low, high), std::max(low, high));
      if (!(std::abs(passed - r) <= kRounding * r)) continue;
      const double at = passed == low ? a
                        : passed == high
                            ? b
                            : zero_between([&s, r](double x) { return s.radius(x) - r; }, a, b);
      const auto l = first_after(from.l + at, after_l);
      if (l && (!found || *l < *found)) found = l;
    }
  }
  return found;
}

std::optional<DoubleDouble> KerrRadius::next_least(const DoubleDouble& after_l) const {
  std::optional<DoubleDouble> found;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
    const Node &from = nodes_[k], &to = nodes_[k + 1];
    if (from.speed > 0 || !(to.speed > 0)) continue;
    const NodeSeries s = series_of(from);
    const auto l = first_after(
        from.l + zero_between([&s](double x) { return s.speed(x); }, 0, double(to.l - from.l)),
        after_l);
    if (l && (!found || *l < *found)) found = l;
  }
  return found;
}

}  // namespace domefall
