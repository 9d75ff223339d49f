#include "pipeline/light/kerr_body_track.h"

#include <algorithm>
#include <cmath>

namespace domefall {

// By Newton's method, since v grows with tau.  Before it begins and after it ends a body is where it was
// then, so that cells of a net that reach beyond have corners.
std::optional<KerrBodyTrack::Spot> KerrBodyTrack::found(double null_time, double guess) const {
  const BodyMotion& motion = rays_.motion();
  double low = motion.begin, high = motion.end;
  double tau = guess > low && guess < high ? guess
               : std::isfinite(low)        ? (std::isfinite(high) ? (low + high) / 2 : low + 1)
                                           : std::min(0.0, high - 1);
  for (int i = 0; i < 80; ++i) {
    const auto body = rays_.body(tau);
    if (!body) return std::nullopt;
    const double over = body->null_time - null_time;
    (over > 0 ? high : low) = tau;
    if (std::abs(over) <= 1e-6 || !(high - low > 1e-9 * (1 + std::abs(tau))))
      return Spot{1 / body->at.r, tau, body->at.place};
    const double next = tau - over / null_time_along(rays_.at().hole, body->at, body->velocity);
    tau = next > low && next < high ? next : (std::max(low, -1e15) + std::min(high, 1e15)) / 2;
  }
  return std::nullopt;
}

const std::optional<KerrBodyTrack::Spot>& KerrBodyTrack::node(long long k) {
  const auto known = nodes_.find(k);
  if (known != nodes_.end()) return known->second;
  // Without a neighbour the body's clock is taken for v.
  double guess = static_cast<double>(k) * step_;
  for (const long long beside : {k - 1, k + 1})
    if (const auto next = nodes_.find(beside); next != nodes_.end() && next->second)
      guess = next->second->tau + static_cast<double>(k - beside) * step_;
  return nodes_.emplace(k, found(static_cast<double>(k) * step_, guess)).first->second;
}

std::optional<KerrBodyTrack::Spot> KerrBodyTrack::at(double null_time) {
  const double step = std::floor(null_time / step_), part = null_time / step_ - step;
  const auto& low = node(static_cast<long long>(step));
  const auto& high = node(static_cast<long long>(step) + 1);
  // Next to its ends it is where it begins or ends.
  if (!low || !high) return low ? low : high;
  const auto between = [&](double a, double b) { return a + (b - a) * part; };
  return Spot{between(low->w, high->w), between(low->tau, high->tau),
              (low->place * (1 - part) + high->place * part).normalized()};
}

}  // namespace domefall
