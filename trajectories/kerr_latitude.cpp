#include "trajectories/kerr_latitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

}  // namespace

KerrLatitude::KerrLatitude(double k, const V3d& n, const V3d& speed)
    : c_(speed.length2() - k * n.z * n.z), k_(k) {
  follow({0, n, speed});
  series_.reserve(nodes_.size());
  for (const Node& node : nodes_) series_.push_back(series(node));
}

KerrLatitude::NodeSeries KerrLatitude::series_of(const Node& node) const {
  return series_.empty() ? series(node) : series_[static_cast<std::size_t>(&node - nodes_.data())];
}

KerrLatitude::NodeSeries KerrLatitude::series(const Node& at) const {
  NodeSeries s{};
  Series bent{};
  for (int i = 0; i < 3; ++i) {
    s.n[static_cast<std::size_t>(i)][0] = at.n[i];
    s.n[static_cast<std::size_t>(i)][1] = at.speed[i];
  }
  for (int n = 0; n < kTerms; ++n) {
    const auto j = static_cast<std::size_t>(n);
    s.square[j] = product(s.n[2], s.n[2], n);
    bent[j] = -2 * k_ * s.square[j] - (n == 0 ? c_ : 0);
    for (std::size_t i = 0; i < 3; ++i) {
      double pulled = product(bent, s.n[i], n);
      if (i == 2) pulled += k_ * s.n[2][j];
      s.n[i][j + 2] = pulled / ((n + 1) * (n + 2));
    }
  }
  s.reach = std::min({range(s.n[0], 1), range(s.n[1], 1), range(s.n[2], 1)});
  return s;
}

KerrLatitude::Node KerrLatitude::after(const Node& at, const NodeSeries& s, double h) {
  Node next{at.l + h, {}, {}, at.squares + integral(s.square, h)};
  for (int i = 0; i < 3; ++i) {
    next.n[i] = value(s.n[static_cast<std::size_t>(i)], h);
    next.speed[i] = slope(s.n[static_cast<std::size_t>(i)], h);
  }
  // Rounding leaves the sphere by some 1e-16 a step.
  next.n.normalize();
  const double from = std::atan2(at.n.y, at.n.x), to = std::atan2(next.n.y, next.n.x);
  next.turned = at.turned + std::remainder(to - from, 2 * pi);
  return next;
}

void KerrLatitude::follow(const Node& start) {
  NodeSeries s = series(start);
  nodes_.push_back(start);
  const double own = std::abs(c_) + std::abs(k_);
  const bool level =
      std::abs(start.speed.z) <= 1e-14 * std::sqrt(own) && std::abs(2 * s.n[2][2]) <= 1e-13 * own;
  if (level) {
    // It circles at one latitude, and any step serves as a period.
    if (s.reach < HUGE_VAL) {
      sums_ = after(start, s, s.reach);
      period_ = s.reach;
    }
    return;
  }
  std::vector<double> turns;
  if (start.speed.z == 0) turns.push_back(0);
  Node now = start;
  while (turns.size() < 3) {
    Node next = after(now, s, s.reach);
    if (now.speed.z != 0 && (now.speed.z > 0) != (next.speed.z > 0))
      turns.push_back(now.l + zero_between([&](double t) { return slope(s.n[2], t); }, 0, s.reach));
    nodes_.push_back(next);
    now = next;
    s = series(now);
  }
  const double period = turns[2] - turns[0];
  sums_ = at(period);
  period_ = period;
}

KerrLatitude::Node KerrLatitude::at(double l) const {
  const double periods = period_ < HUGE_VAL ? std::floor(l / period_) : 0;
  const double rest = periods != 0 ? l - periods * period_ : l;
  const Node& node = node_before(nodes_, rest);
  Node there = after(node, series_of(node), rest - node.l);
  there.l = l;
  if (periods != 0) {
    const double angle = periods * sums_.turned, cosine = std::cos(angle), sine = std::sin(angle);
    const auto turn = [&](const V3d& v) {
      return V3d(v.x * cosine - v.y * sine, v.x * sine + v.y * cosine, v.z);
    };
    there.n = turn(there.n), there.speed = turn(there.speed);
    there.squares += periods * sums_.squares;
    there.turned += angle;
  }
  return there;
}

}  // namespace domefall
