#include "pipeline/light/ray_orbits.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/light/orbit_ends.h"
#include "pipeline/light/ray_point.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// ---- the invariants, as null_ray.cpp has them ----

// These are what the invariants need of the observer's place.
struct ObserverPlace {
  double r, w, x;                  // x = w - 1/3
  double s, inner;                 // s = sqrt(2/r), 1 - s
  double first, second;            // tan(alpha/2) of the critical rays
  double product, behind;          // kappa = sqrt(first second) outside, and kappa - first
  double outside, inside, turned;  // 1 or 0, 0 or 1; -1 in the outgoing frame, else 1
};

ObserverPlace place_of(const Radius& at, bool outgoing) {
  ObserverPlace o{};
  o.r = at.r;
  o.w = 1 / at.r;
  o.x = -at.above_light_circle / (3 * at.r);
  o.s = Schwarzschild::free_fall_speed(at.r);
  o.inner = Schwarzschild::below_light_speed(at);
  o.first = tan_half_critical(at, Critical::kFirst);
  o.second = tan_half_critical(at, Critical::kSecond);
  o.outside = at.above_horizon > 0 ? 1 : 0;
  o.inside = 1 - o.outside;
  o.turned = outgoing ? -1 : 1;
  if (o.outside > 0) {
    const double first = std::sqrt(o.first), second = std::sqrt(o.second);
    const double apart = 2 * at.above_light_circle * std::sqrt(1 + 6 / at.r);
    o.product = first * second;
    o.behind = apart / (Schwarzschild::kCriticalImpact * (1 + o.s)) * first / (first + second);
  }
  return o;
}

struct InvariantsAt {
  double energy, angular_momentum, radial, below, above;  // as RayInvariants
};

inline InvariantsAt invariants_at(const ObserverPlace& o, double sh, double ch, double gap_first,
                                  double gap_second) {
  const double sum = 1 + o.s, beyond_first = sh + o.first * ch, beyond_second = sh + o.second * ch;
  // One of two numbers is taken by its weight of 1, because a selection by a flag of the loop makes
  // no SIMD code.
  const double below = sum * gap_first * (o.outside * gap_second + o.inside * beyond_second);
  const double above = sum * beyond_first * (o.outside * beyond_second + o.inside * gap_second);
  const double in = sum * sh * sh, out = o.inner * ch * ch;
  const double energy = o.outside * (in + out) + o.inside * ((below + above) / 2);
  const double gap = gap_first - o.behind * ch;
  const double by_gap = sum * (sh + o.product * ch);
  const double gap_size = std::abs(gap_first), turn_size = std::abs(o.behind * ch);
  const double largest = in > out ? in : out;
  const double rounded = (gap_size > turn_size ? gap_size : turn_size) * by_gap;
  const double radial = o.outside * largest <= rounded ? out - in : -gap * by_gap;
  return {energy, 2 * o.r * sh * ch, o.turned * radial, below, above};
}

// ---- the loops ----

// These are the rays, and what becomes of them on the way to their orbits.  They are in one place,
// so that the compiler sees which columns are which.
struct RayBeginnings {
  using Column = RayPlaces::Column;
  alignas(64) Column sin_half, cos_half, gap_first, gap_second;
  alignas(64) Column inverse_b, eps, sense, inwards, radial;  // the last two 1 or 0
  struct Integrals {
    alignas(64) Column a, b, c, factor, value;
  };
  Integrals first, second;
};

[[gnu::always_inline]] inline void gap_loop(double tangent, int count, const RayBeginnings& rays,
                                            double* gaps) {
  for (int k = 0; k < count; ++k) gaps[k] = rays.sin_half[k] - tangent * rays.cos_half[k];
}
Dispatched<gap_loop> make_gaps;

// kFar says whether the observer is beyond the light circle.
template <bool kFar>
[[gnu::always_inline]] inline void begin_loop(const ObserverPlace& observer, int count,
                                              RayBeginnings& rays) {
  RayBeginnings& q = rays;
  const ObserverPlace o = observer;
  for (int k = 0; k < count; ++k) {
    const InvariantsAt i =
        invariants_at(o, q.sin_half[k], q.cos_half[k], q.gap_first[k], q.gap_second[k]);
    const double size = std::abs(i.energy) + std::abs(i.radial);
    const double least = 1e-40 * o.r * size;
    const double l = i.angular_momentum > least ? i.angular_momentum : least, over = 1 / l;
    orbit_ends::Orbit orbit{};
    orbit.e = std::abs(i.energy) * over;
    orbit.eps = (i.below * over) * (i.above * over);
    orbit.w = o.w;
    orbit.x = o.x;
    orbit.p = (i.radial * over) * (i.radial * over);
    const orbit_ends::ComplexPair pair = orbit_ends::complex_pair(orbit.eps);
    const orbit_ends::RealTriple triple = orbit_ends::real_triple(orbit.e, orbit.eps);
    const bool passes = orbit.eps >= 0;
    orbit_ends::CarlsonArguments first = orbit_ends::from_sky_over_pair(pair, orbit);
    orbit_ends::CarlsonArguments second = orbit_ends::to_singularity_over_pair(pair, orbit);
    if constexpr (kFar) {
      first = orbit_ends::chosen(passes, first, orbit_ends::from_sky_below_turn(triple, orbit));
      second = orbit_ends::chosen(passes, second, orbit_ends::from_sky_to_turn(triple));
    } else {
      first =
          orbit_ends::chosen(passes, first, orbit_ends::to_singularity_above_turn(triple, orbit));
      second = orbit_ends::chosen(passes, second, orbit_ends::from_singularity_to_turn(triple));
    }
    q.first.a[k] = first.a;
    q.first.b[k] = first.b;
    q.first.c[k] = first.c;
    q.first.factor[k] = first.factor;
    q.second.a[k] = second.a;
    q.second.b[k] = second.b;
    q.second.c[k] = second.c;
    q.second.factor[k] = second.factor;
    q.sense[k] = i.energy < 0 ? -1 : 1;
    q.inwards[k] = i.radial > 0 ? 1 : 0;
    q.radial[k] = i.angular_momentum > least ? 0 : 1;
    q.inverse_b[k] = orbit.e;
    q.eps[k] = orbit.eps;
  }
}
Dispatched<begin_loop<true>> begin_far_orbits;
Dispatched<begin_loop<false>> begin_near_orbits;

[[gnu::always_inline]] inline void integral_loop(int count,
                                                 RayBeginnings::Integrals& __restrict q) {
  for (int k = 0; k < count; ++k)
    q.value[k] = q.factor[k] * orbit_ends::carlson_rf(q.a[k], q.b[k], q.c[k]);
}
Dispatched<integral_loop> find_integrals;

[[gnu::always_inline]] inline void end_loop(const RayBeginnings& __restrict q, double x, int count,
                                            OrbitColumns& __restrict to) {
  for (int k = 0; k < count; ++k) {
    const double eps = q.eps[k], first = q.first.value[k], second = q.second.value[k];
    // Only numbers are selected, because of selections of flags GCC makes no SIMD code.
    const double inwards = q.inwards[k], far = x < 0 ? 1 : 0;
    const double turns = inwards * far + (1 - inwards) * (1 - far);
    // On the critical orbit the far side of the light circle is out of reach.
    const double beyond = eps == 0 ? OrbitColumns::kEndless : 0;
    const double sky = (x >= 0 ? beyond : 0) + first, singularity = (x <= 0 ? beyond : 0) + second;
    const double over = inwards > 0 ? singularity : sky, back = inwards > 0 ? sky : singularity;
    const double around = turns > 0 ? 2 * second - first : first;
    const double before = turns > 0 ? first : OrbitColumns::kEndless;
    const double left = eps >= 0 ? over : around;
    to.inverse_b[k] = q.inverse_b[k];
    to.eps[k] = eps;
    to.sense[k] = q.sense[k];
    to.left[k] = q.radial[k] > 0 ? 0 : left;
    to.behind[k] = eps >= 0 ? back : before;
    to.to_sky[k] = eps >= 0 ? 1 - inwards : far;
    to.from_sky[k] = eps >= 0 ? inwards : far;
  }
}
Dispatched<end_loop> end_orbits;

[[gnu::always_inline]] inline void find_loop(const OrbitColumns& __restrict in,
                                             const double* __restrict psi, int count,
                                             RayPlaces& __restrict places) {
  for (int k = 0; k < count; ++k) {
    const double left = in.left[k] - psi[k], passed = in.behind[k] + psi[k];
    // The place is found from the nearer end, where nothing cancels.
    const bool ahead = left <= passed;
    const double to_sky = in.to_sky[k], from_sky = in.from_sky[k];
    // The one of two flags that counts is taken by arithmetic, because of selections of flags GCC
    // makes no SIMD code.
    const double is_ahead = ahead ? 1 : 0, sky_flag = is_ahead * to_sky + (1 - is_ahead) * from_sky;
    const bool sky = sky_flag > 0;
    const double e = in.inverse_b[k];
    const RayPoint s = point_from_singularity(e, in.eps[k], ahead ? left : passed);
    const SkyPoint far = point_from_sky(e, s);
    const double near = 1 / s.w, r = sky ? far.r : near;
    const double steep = r * r * (sky ? far.speed : s.speed);
    const bool ended = !(left > 0);
    const double end = to_sky > 0 ? HUGE_VAL : 0;
    places.r[k] = ended ? end : r;
    places.slope[k] = ended ? 0 : steep * ((2 * is_ahead - 1) * (2 * sky_flag - 1));
  }
}
Dispatched<find_loop> find_places;

}  // namespace

void RayOrbits::set(const Radius& at, bool outgoing, const RayColumns& rays, int count) {
  at_ = at;
  outgoing_ = outgoing;
  count_ = count;
  const ObserverPlace observer = place_of(at, outgoing);
  RayBeginnings orbits;
  std::copy_n(rays.sin_half, count, orbits.sin_half.begin());
  std::copy_n(rays.cos_half, count, orbits.cos_half.begin());
  const auto set_gaps = [&](const double* given, double tangent, RayPlaces::Column& gaps) {
    if (given)
      std::copy_n(given, count, gaps.begin());
    else
      make_gaps(tangent, count, orbits, gaps.data());
  };
  set_gaps(rays.gap_first, observer.first, orbits.gap_first);
  set_gaps(rays.gap_second, observer.second, orbits.gap_second);
  if (observer.x < 0)
    begin_far_orbits(observer, count, orbits);
  else
    begin_near_orbits(observer, count, orbits);
  find_integrals(count, orbits.first);
  find_integrals(count, orbits.second);
  end_orbits(orbits, observer.x, count, orbits_);
}

void RayOrbits::find(const double* psi, RayPlaces& places) const {
  find_places(orbits_, psi, count_, places);
}

}  // namespace domefall
