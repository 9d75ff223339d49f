#include "pipeline/light/charged_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

constexpr int kLanes = 16, kOrder = 16;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
using Lanes = std::array<double, kLanes>;

// What the rays of one observer have in common.
struct PathSpace {
  double charge_squared, horizon_w;
};

// The rays of a block at one of their steps.
struct PathBlock {
  alignas(64) Lanes w, slope;  // w and dw/dpsi
  alignas(64) Lanes left;      // the angle that is left
  alignas(64) Lanes step, rate;
  alignas(64) Lanes past;                            // 1 once the past horizon has been met
  alignas(64) std::array<Lanes, kOrder + 1> series;  // of w, in parts of the step
  double most;                                       // the largest angle that is left
};

// Makes one step of all rays, and leaves its series.  A step is short against the distance, in the
// plane of complex angles, to where w would be infinite.  With E/L = e that is about 1/sqrt(e) or
// 1/sqrt(w).
[[gnu::always_inline]] inline void path_step_loop(const PathSpace& space, PathBlock& block) {
  constexpr double kStep = 0.4;
  PathBlock& b = block;
  const PathSpace own = space;
  auto& w = b.series;
  Lanes square[kOrder - 1];
  for (int k = 0; k < kLanes; ++k) {
    const double size = b.w[k] > 0 ? b.w[k] : 0;
    const double step = kStep / (b.rate[k] + __builtin_sqrt(size));
    b.step[k] = step < b.left[k] ? step : b.left[k];
    w[0][k] = b.w[k];
    w[1][k] = b.step[k] * b.slope[k];
  }
  for (std::size_t n = 0; n + 2 <= kOrder; ++n) {
    Lanes sum{}, cube{};
    for (std::size_t j = 0; j <= n; ++j)
      for (int k = 0; k < kLanes; ++k) sum[k] += w[j][k] * w[n - j][k];
    square[n] = sum;
    for (std::size_t j = 0; j <= n; ++j)
      for (int k = 0; k < kLanes; ++k) cube[k] += w[j][k] * square[n - j][k];
    const double over = 1.0 / static_cast<double>((n + 1) * (n + 2));
    for (int k = 0; k < kLanes; ++k)
      w[n + 2][k] = over * (b.step[k] * b.step[k]) *
                    (3 * sum[k] - w[n][k] - 2 * own.charge_squared * cube[k]);
  }
  Lanes place{}, rise{};
  for (std::size_t n = kOrder; n > 0; --n)
    for (int k = 0; k < kLanes; ++k) {
      place[k] += w[n][k];
      rise[k] += static_cast<double>(n) * w[n][k];
    }
  double most = 0;
  for (int k = 0; k < kLanes; ++k) {
    const double now = place[k] + w[0][k], step = b.step[k];
    const double slope = step > 0 ? rise[k] / step : b.slope[k];
    // Rays end on the past horizon, which they meet inwards, and on a sky.
    const double in = slope > 0 ? (now >= own.horizon_w ? 1.0 : 0.0) : 0.0;
    const double out = now <= 0 ? 1.0 : 0.0, ends = in + out;
    b.past[k] = in > 0 ? 1 : b.past[k];
    b.w[k] = ends > 0 ? 0 : now;
    b.slope[k] = ends > 0 ? 0 : slope;
    b.left[k] = ends > 0 ? 0 : b.left[k] - step;
    most = b.left[k] > most ? b.left[k] : most;
  }
  b.most = most;
}
Dispatched<path_step_loop> make_step;

// ---- times ----

// Returns w''.
double curvature(const PathSpace& space, double w) {
  return w * (-1 + w * (3 - 2 * space.charge_squared * w));
}

struct SeriesPoint {
  double w, slope;  // slope by part of the step
};

SeriesPoint at_part(const PathBlock& b, std::size_t k, double part) {
  double w = 0, slope = 0;
  for (std::size_t n = kOrder + 1; n-- > 0;) {
    slope = slope * part + w;
    w = w * part + b.series[n][k];
  }
  return {w, slope};
}

// Returns N over a part of the step in which the ray does not turn, by Gauss's rule.
double delay(const PathBlock& b, std::size_t k, double e, double from, double to) {
  constexpr std::array<double, 3> kNodes{0.2386191860831969, 0.6612093864662645,
                                         0.9324695142031521},
      kWeights{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double middle = (from + to) / 2, half = (to - from) / 2, step = b.step[k];
  double sum = 0;
  for (std::size_t j = 0; j < kNodes.size(); ++j)
    for (const double side : {-1.0, 1.0})
      sum += kWeights[j] * step /
             (e + std::abs(at_part(b, k, middle + side * half * kNodes[j]).slope) / step);
  return half * sum;
}

// A Clock sums up the time of one ray.
struct Clock {
  double delay_sum = 0, turn_w = 0;

  void add_step(const PathSpace& space, const PathBlock& b, std::size_t k, double e) {
    if (!(b.step[k] > 0)) return;
    const double before = b.series[1][k], after = at_part(b, k, 1).slope;
    double turn = 1;
    if ((before > 0) != (after > 0)) {
      // A mistake of the turn enters N and its w by its square only.
      turn = before / (before - after);
      for (int n = 0; n < 3; ++n) {
        const SeriesPoint at = at_part(b, k, turn);
        turn -= at.slope / (b.step[k] * b.step[k] * curvature(space, at.w));
      }
      turn_w = at_part(b, k, turn).w;
    }
    delay_sum += delay(b, k, e, 0, turn);
    if (turn < 1) delay_sum += delay(b, k, e, turn, 1);
  }
};

}  // namespace

ChargedPaths::ChargedPaths(const ChargedHole& hole, double r)
    : hole_(hole),
      w_(1 / r),
      horizon_w_(1 / hole.horizon()),
      charge_squared_(hole.charge * hole.charge),
      tortoise_(hole.tortoise(r)) {}

void ChargedPaths::find(const double* p, const double* e, const double* psi, int count,
                        Places& places) const {
  follow(p, e, psi, count, false, places);
}

void ChargedPaths::timed(const double* p, const double* e, const double* psi, int count,
                         Places& places) const {
  follow(p, e, psi, count, true, places);
}

void ChargedPaths::follow(const double* p, const double* e, const double* psi, int count,
                          bool with_times, Places& places) const {
  const PathSpace space{charge_squared_, horizon_w_};
  for (int first = 0; first < count; first += kLanes) {
    PathBlock block{};
    const auto rays = static_cast<std::size_t>(std::min(kLanes, count - first));
    for (std::size_t k = 0; k < rays; ++k) {
      const std::size_t ray = static_cast<std::size_t>(first) + k;
      block.w[k] = w_;
      block.slope[k] = p[ray];
      block.left[k] = psi[ray];
      block.rate[k] = 1 + std::sqrt(std::abs(e[ray]));
    }
    std::array<Clock, kLanes> clocks;
    do {
      make_step(space, block);
      for (std::size_t k = 0; with_times && k < rays; ++k)
        clocks[k].add_step(space, block, k, e[static_cast<std::size_t>(first) + k]);
    } while (block.most > 0);
    for (std::size_t k = 0; k < rays; ++k) {
      const std::size_t ray = static_cast<std::size_t>(first) + k;
      places.w[ray] = block.past[k] > 0 ? kInfinite : block.w[k];
      places.slope[ray] = block.slope[k];
      if (with_times)
        places.time[ray] = time(p[ray] > 0, clocks[k].delay_sum, clocks[k].turn_w, places.w[ray]);
    }
  }
}

// Outwards v falls by N, and inwards u does.  They differ by 2 r*.
double ChargedPaths::time(bool inwards, double delay, double turn_w, double w) const {
  const bool ends_inwards = inwards != (turn_w > 0);
  if (ends_inwards && !(w < horizon_w_)) return -kInfinite;
  const double turn = turn_w > 0 ? hole_.tortoise(1 / turn_w) : 0;
  const double from = inwards ? tortoise_ : turn, to = ends_inwards ? hole_.tortoise(1 / w) : turn;
  return 2 * (to - from) - delay;
}

}  // namespace domefall
