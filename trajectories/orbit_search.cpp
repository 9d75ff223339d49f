#include "trajectories/orbit_search.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace domefall {
namespace {

// If a difference of terms of about 1 is less than this, it has lost digits and is found from the
// roots instead.
constexpr double kCancels = 0.01;

// Returns the zero of f in (low, high], of a function that changes its sign there, or high if it
// does not.
template <class Function>
double zero(const Function& f, double low, double high) {
  const double at_low = f(low), at_high = f(high);
  if (at_high == 0 || (at_low > 0) == (at_high > 0)) return high;
  std::uintmax_t steps = 300;
  const auto close = [](double a, double b) {
    return std::abs(b - a) <= 2 * std::numeric_limits<double>::epsilon() * std::abs(a);
  };
  const auto found = boost::math::tools::toms748_solve(f, low, high, at_low, at_high, close, steps);
  return (found.first + found.second) / 2;
}

// A State is the one whose orbit is sought, with w = 1/r.
struct State {
  OrbitConstants c;
  double w, speed;

  // Returns (P(w + h) - P(w))/h.
  double slope(double h) const {
    const double l = c.angular_momentum, to = w + h;
    return 2 + l * l * (2 * (to * to + to * w + w * w) - (to + w));
  }

  // Returns how far the next turning point is on the side of `sign`, in w.  It is at most `most`
  // away.
  double to_turn(double sign, double most) const {
    if (speed != 0)
      return zero([&](double h) { return speed * speed + sign * h * slope(sign * h); }, 0, most);
    if (sign * slope(0) <= 0) return 0;
    return zero([&](double h) { return sign * slope(sign * h); }, 0, most);
  }

  // A Top is 1/r of the next apoastron, and how far it is in w, at most `most`.
  struct Top {
    double w, risen;
  };
  Top apoastron(double most) const;
};

// For an apoastron far away the difference has lost digits, which Newton's method gives back.  It
// is well conditioned there, because P' is nearly 2.
State::Top State::apoastron(double most) const {
  if (c.energy == 0) return {0.5, w - 0.5};
  const double risen = to_turn(-1, most), l2 = c.angular_momentum * c.angular_momentum;
  double top = w - risen;
  if (!(top < w / 4 && l2 * top < 0.25)) return {top, risen};
  constexpr int kSteps = 3;
  for (int k = 0; k < kSteps; ++k)
    top -=
        (c.excess_energy + top * (2 + l2 * top * (2 * top - 1))) / (2 + l2 * top * (6 * top - 2));
  return {top, w - top};
}

double outward_sign(double speed) { return speed > 0 ? 1 : -1; }

OrbitStart unturned(const State& state, double w_b, double over) {
  const bool escaping = state.speed > 0;
  const double excess = state.c.angular_momentum > 4 ? std::max(over, kLeastExcess) : kLeastExcess;
  OrbitStart start{OrbitCurve::unturned(state.c, escaping, w_b, excess), 0};
  start.parameter = start.curve.parameter(1 / state.w, escaping);
  return start;
}

// Returns the fall from that apoastron.  `excess` is as OrbitCurve::returning wants it.
// E^2 = (1 - 2/r_a)(1 + L^2/r_a^2) gives r_a - 2.
OrbitStart returning(const State& state, const State::Top& top, double excess) {
  const double lw = state.c.angular_momentum * top.w;
  const double over_two = state.c.energy * state.c.energy / (top.w * (1 + lw * lw));
  return {OrbitCurve::returning(state.c, 1 / top.w, over_two, std::max(excess, kLeastExcess)),
          -outward_sign(state.speed) * std::asinh(std::sqrt(top.risen / top.w))};
}

// Returns G of OrbitCurve::returning, with no barrier or one that is overcome by `over`.
double returning_excess(const State& state, double w, const Barrier* barrier, double over) {
  const double l = state.c.angular_momentum;
  if (w >= 1.0 / 6) return 2 - 2 * l * l * w * (1 - 3 * w);
  const double least = 2 - l * l * (1 - 2 * w) * (1 + 6 * w) / 8;
  if (barrier == nullptr || least > kCancels) return least;
  const double off = l * (barrier->w - (1 - 2 * w) / 4);
  return over / (barrier->w - w) - 2 * off * off;
}

OrbitStart falling(const State& state, const Barrier* barrier, double over) {
  const State::Top top = state.apoastron(state.w);
  return returning(state, top, returning_excess(state, top.w, barrier, over));
}

OrbitStart turned_inside(const State& state, const BarrierRoots& beside, const Barrier& barrier) {
  const double l = state.c.angular_momentum, gap = beside.below + beside.above;
  const State::Top top = state.apoastron(std::max(state.w - barrier.w, 0.0));
  // Next to the barrier, this is 2 L^2 (w3 - w1)(w3 - w2) with the third root
  // w1 = w_b - spread + below - above.
  const double plain = 2 - 2 * l * l * top.w * (1 - 3 * top.w);
  const double to_third = barrier.spread - beside.below + 2 * beside.above;
  return returning(state, top, plain > kCancels ? plain : 2 * l * l * to_third * gap);
}

OrbitStart turned_outside(const State& state, const BarrierRoots& beside, const Barrier& barrier) {
  const double l = state.c.angular_momentum, side = outward_sign(state.speed);
  const double gap = std::max(beside.below + beside.above, kLeastExcess);
  const double sunk = state.to_turn(1, std::max(barrier.w - state.w, 0.0));
  const double w2 = state.w + sunk, near = 1 / w2;
  if (state.c.excess_energy >= 0) {
    const double w1 = -state.c.excess_energy / (2 * l * l * w2 * (barrier.w + beside.above));
    return {OrbitCurve::scattered(state.c, near, w1, gap),
            side * std::asinh(std::sqrt(sunk / state.w))};
  }
  const State::Top top = state.apoastron(state.w);
  const double far = 1 / top.w;
  return {OrbitCurve::bound(state.c, near, far, gap),
          side * 2 * std::atan2(std::sqrt(sunk * near), std::sqrt(top.risen * far))};
}

}  // namespace

Barrier barrier_of(double angular_momentum) {
  const double l2 = angular_momentum * angular_momentum;
  const double root = std::sqrt(std::max(0.0, 1 - 12 / l2));
  return {(1 + root) / 6, root / 2};
}

BarrierRoots roots_beside(const Barrier& barrier, double angular_momentum, double depth) {
  if (!(depth > 0)) return {0, 0};
  const double level = depth / (2 * angular_momentum * angular_momentum), q = barrier.spread;
  const double below = zero([&](double y) { return y * y * (q - y) - level; }, 0, 2 * q / 3);
  const double above = zero([&](double z) { return z * z * (q + z) - level; }, 0, std::cbrt(level));
  return {below, above};
}

OrbitCurve scattered_orbit(const OrbitConstants& constants, double depth) {
  const double l = constants.angular_momentum;
  const Barrier barrier = barrier_of(l);
  const BarrierRoots beside = roots_beside(barrier, l, depth);
  const double w2 = barrier.w - beside.below, w3 = barrier.w + beside.above;
  return OrbitCurve::scattered(constants, 1 / w2, -constants.excess_energy / (2 * l * l * w2 * w3),
                               std::max(beside.below + beside.above, kLeastExcess));
}

OrbitStart orbit_through(const OrbitConstants& constants, double r, double speed) {
  const State state{constants, 1 / r, speed};
  const double l = constants.angular_momentum;
  const bool unbound = constants.excess_energy >= 0;
  if (l * l <= 12) return unbound ? unturned(state, 0.25, 0) : falling(state, nullptr, 0);
  const Barrier barrier = barrier_of(l);
  const double off = l * (state.w - barrier.w);
  const double over = speed * speed - 2 * off * off * (state.w - barrier.w + barrier.spread);
  if (over > 0) return unbound ? unturned(state, barrier.w, over) : falling(state, &barrier, over);
  const BarrierRoots beside = roots_beside(barrier, l, -over);
  if (state.w >= barrier.w) return turned_inside(state, beside, barrier);
  return turned_outside(state, beside, barrier);
}

}  // namespace domefall
