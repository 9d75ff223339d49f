#include "pipeline/light/ray_times.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/light/emission_time.h"
#include "pipeline/light/orbit_ends.h"
#include "pipeline/light/orbit_time.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// These are places on orbits, each by the angle from an end, and N from there.  They are in one
// structure, so that the compiler sees which columns are which.
struct EndTimes {
  alignas(64) RayPlaces::Column inverse_b, eps, angle, sky;  // sky: 1, or 0 for the singularity
  alignas(64) RayPlaces::Column ahead;  // 1 if that end is the one the ray comes to
  alignas(64) RayPlaces::Column n;
};

[[gnu::always_inline]] inline void end_times_loop(int count, EndTimes& ends) {
  EndTimes& q = ends;
  for (int k = 0; k < count; ++k) {
    const double e = q.inverse_b[k], eps = q.eps[k], angle = q.angle[k], sky = q.sky[k];
    const double n = time_from_singularity(e, eps, angle);
    const RayPoint s = point_from_singularity(e, eps, angle);
    const double far = n + s.w / (e * (e + s.speed));
    q.n[k] = sky > 0 ? far : n;
  }
}
Dispatched<end_times_loop> find_end_times;

// The time is found from the nearer end.
[[gnu::always_inline]] inline void nearer_end_loop(const OrbitColumns& __restrict orbits,
                                                   const double* __restrict psi, int count,
                                                   EndTimes& __restrict ends) {
  for (int k = 0; k < count; ++k) {
    const double left = orbits.left[k] - psi[k], passed = orbits.behind[k] + psi[k];
    const double ahead = left <= passed ? 1 : 0;
    ends.angle[k] = left <= passed ? left : passed;
    ends.sky[k] = ahead * orbits.to_sky[k] + (1 - ahead) * orbits.from_sky[k];
    ends.ahead[k] = ahead;
  }
}
Dispatched<nearer_end_loop> find_nearer_ends;

// Times count from the back end of each path.  One without such an end counts from its other end,
// downwards.
void find_times_so_far(const OrbitColumns& orbits, const double* psi, const PathTimes& paths,
                       int count, EndTimes& ends) {
  find_nearer_ends(orbits, psi, count, ends);
  find_end_times(count, ends);
  for (int k = 0; k < count; ++k)
    if (ends.ahead[k] > 0) ends.n[k] = paths.total[k] - ends.n[k];
}

// Returns r* of the turning point of an orbit, if it has one, by the root of P on the observer's
// side.
double turning_star(double e, double eps, bool sky) {
  const orbit_ends::RealTriple root = orbit_ends::real_triple(e, eps);
  const double w = sky ? root.w2 : root.w1, below_half = sky ? 0.5 - root.w2 : root.below_half;
  return 1 / w + 2 * logarithm(below_half / w);
}

// These are what times count by, which are the sign of r* in the coordinate, and r* of the
// observer.
struct TimeOrigin {
  double sign, observer;
};

[[gnu::always_inline]] inline void find_times_loop(const OrbitColumns& __restrict orbits,
                                                   const PathTimes& __restrict paths,
                                                   const TimeOrigin& origin, const EndTimes& ends,
                                                   const double* __restrict r, int count,
                                                   double* __restrict times) {
  constexpr double kNextToHorizon = 1e-20;
  const TimeOrigin own = origin;
  for (int k = 0; k < count; ++k) {
    const double n = ends.n[k] - paths.observer[k];
    const double to_sky = orbits.to_sky[k], turn = paths.turn[k], sense = orbits.sense[k];
    const double back = orbits.behind[k] < OrbitColumns::kEndless ? 1 : 0;
    const double turns = orbits.eps[k] < 0 ? back : 0, crossed = turns * ends.ahead[k];
    // Back in time a path begins outwards (1) or inwards (-1), and goes on likewise or has turned.
    const double begins = (1 - 2 * turns) * (2 * to_sky - 1), goes = begins * (1 - 2 * crossed);
    const double off = std::abs(r[k] / 2 - 1);
    const double there = r[k] + 2 * logarithm(off > kNextToHorizon ? off : kNextToHorizon);
    // Outwards t + r* falls by N, and inwards t - r* does.  With E < 0, -t stands for t.
    const double from_here = (sense * begins - own.sign) * own.observer;
    const double from_there = (own.sign - sense * goes) * there;
    const double time = from_here + from_there - sense * (n + 2 * begins * crossed * turn);
    times[k] = ends.angle[k] > 0 ? time : 0;
  }
}
Dispatched<find_times_loop> find_times;

}  // namespace

RayTimes::RayTimes(const RayOrbits& orbits) : orbits_(orbits) {
  const OrbitColumns& q = orbits.columns();
  const int count = orbits.count();
  EndTimes ends;
  std::copy_n(q.inverse_b.begin(), count, ends.inverse_b.begin());
  std::copy_n(q.eps.begin(), count, ends.eps.begin());
  for (int k = 0; k < count; ++k) ends.angle[k] = (q.left[k] + q.behind[k]) / 2;
  std::copy_n(q.to_sky.begin(), count, ends.sky.begin());
  find_end_times(count, ends);
  std::copy_n(ends.n.begin(), count, paths_.total.begin());
  std::copy_n(q.from_sky.begin(), count, ends.sky.begin());
  find_end_times(count, ends);
  for (int k = 0; k < count; ++k) {
    const bool turns = q.eps[k] < 0;
    paths_.total[k] = 2 * ends.angle[k] < OrbitColumns::kEndless ? paths_.total[k] + ends.n[k] : 0;
    paths_.turn[k] = turns ? turning_star(q.inverse_b[k], q.eps[k], q.to_sky[k] > 0) : 0;
  }
  const RayPlaces::Column here{};
  find_times_so_far(q, here.data(), paths_, count, ends);
  std::copy_n(ends.n.begin(), count, paths_.observer.begin());
}

void RayTimes::find(const double* psi, const RayPlaces& places, double* times) const {
  // On the horizon itself r* is that of r - 2 = -1e-20, as in emission_time.cpp.
  Radius at = orbits_.at();
  if (at.above_horizon == 0) at.above_horizon = -1e-20;
  const TimeOrigin origin{orbits_.is_outgoing() ? -1.0 : 1.0, Schwarzschild::tortoise(at)};
  const OrbitColumns& q = orbits_.columns();
  const int count = orbits_.count();
  EndTimes ends;
  std::copy_n(q.inverse_b.begin(), count, ends.inverse_b.begin());
  std::copy_n(q.eps.begin(), count, ends.eps.begin());
  find_times_so_far(q, psi, paths_, count, ends);
  find_times(q, paths_, origin, ends, places.r.data(), count, times);
}

}  // namespace domefall
