#include "pipeline/light/traced_ray.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/light/integrated_ray.h"
#include "pipeline/light/ray_position.h"
#include "pipeline/light/ray_times.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// A View says how delta in the observer's frame becomes alpha.
struct View {
  RadialFrame frame;
  bool from_behind;  // alpha = pi - delta
};

View view_of(TraceObserver observer) {
  switch (observer) {
    case TraceObserver::kStatic:
    case TraceObserver::kTwo:
      return {{false, true}, false};
    case TraceObserver::kFour:
      return {{true, true}, false};
    case TraceObserver::kOutgoing:
      return {{true, false}, true};
    case TraceObserver::kRain:
      break;
  }
  return {{false, false}, false};
}

Critical critical_of(const View& view, Edge edge) {
  return edge == Edge::kRegionThree || view.from_behind ? Critical::kSecond : Critical::kFirst;
}

NullRay ray_of(const RayRequest& q, const View& view) {
  if (q.edge) {
    const double offset = view.from_behind ? -q.offset : q.offset;
    return ray_off_edge(q.at, critical_of(view, *q.edge), offset, view.frame);
  }
  const PolarAngle delta = polar_angle(q.delta);
  return ray_at(q.at, view.from_behind ? delta.reversed() : delta, view.frame);
}

// Seen has the observer's half angle, found from the frame of the ray.
struct Seen {
  double delta;
  double sine;     // of delta, from the ray's own half angles: whole near 0 and pi too
  double doppler;  // omega_observer/omega_frame, which is also d alpha/d alpha_observer
};

Seen seen(const NullRay& ray, const View& view) {
  const double k = kappa(ray.at, view.frame), sine = ray.sin_half / k;
  const double alpha = 2 * std::atan2(sine, ray.cos_half);
  const double behind = 2 * std::atan2(ray.cos_half, sine);
  const double norm2 = sine * sine + ray.cos_half * ray.cos_half;
  return {view.from_behind ? behind : alpha, 2 * sine * ray.cos_half / norm2, k * norm2};
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void set_amplification(TracedRay& ray, double sine) {
  const double slope = std::abs(ray.slope);
  // At the far end of a sky both sines vanish, and their ratio is 1/slope.
  const bool far_end = ray.origin != SkyRegion::kIV && ray.phi < 1e-6;
  ray.amplification = far_end ? 1 / (slope * slope) : sine / (std::abs(std::sin(ray.phi)) * slope);
}

struct Sweep {
  double phi, slope;  // d phi/d alpha, signed
};

// Returns the optics of one radius, with only the tables that were asked for.
const HoleOptics& optics_at(const Radius& at, bool outgoing, int bits, SkyRegion origin) {
  thread_local HoleOptics kept;
  const Tetrad tetrad = outgoing ? Tetrad::kOutgoing : Tetrad::kRain;
  const bool same = kept.at.r == at.r && kept.at.above_horizon == at.above_horizon &&
                    kept.at.above_light_circle == at.above_light_circle && kept.tetrad == tetrad &&
                    kept.table_bits == bits;
  WantedSkies none;
  none.sky = {};
  if (!same) kept = make_hole_optics(at, tetrad, none);
  kept.table_bits = bits;
  WantedSkies wanted{};
  for (const SkyRegion sky : kEverySky) wanted.sky[sky] = sky == origin;
  add_tables(kept, wanted);
  return kept;
}

Sweep by_table(const NullRay& ray, SkyRegion origin, int bits) {
  const HoleOptics& optics = optics_at(ray.at, ray.outgoing, bits, origin);
  if (origin == SkyRegion::kIV) {
    const WhiteHoleTable::Place place = optics.white_hole->place_of(ray);
    return {optics.white_hole->azimuth(place), optics.white_hole->slope(place)};
  }
  const SkyTable& table = *optics.table_of(origin);
  const double x = distance_of(table.zone(), ray);
  return {table.azimuth(x), -table.slope(x) * table.zone().edge.sign};
}

// ---- by integrators ----

Integrator integrator_of(TraceMethod method) {
  switch (method) {
    case TraceMethod::kFullDopri5:
      return Integrator::kFullDopri5;
    case TraceMethod::kFullRkf78:
      return Integrator::kFullRkf78;
    case TraceMethod::kBinetDopri5:
      return Integrator::kBinetDopri5;
    case TraceMethod::kBinetRkf78:
      return Integrator::kBinetRkf78;
    default:
      return Integrator::kPaperRk4;
  }
}

// Returns E, L and k^r of a ray seen at delta, written plainly ([Riazuelo] eq. def_k_prec).  What
// that loses beside an edge is the methods' own.
PhotonAtObserver photon_at(TraceObserver observer, const Radius& at, double delta) {
  const double s = Schwarzschild::free_fall_speed(at.r), c = std::cos(delta);
  const double rest = std::sqrt(std::abs(at.above_horizon) / at.r);
  PhotonAtObserver k{at.above_horizon > 0 ? Region::kI : Region::kII, at.r, 0,
                     at.r * std::sin(delta), 0};
  switch (observer) {
    case TraceObserver::kRain:
      k.energy = 1 - s * c, k.radial = c - s;
      break;
    case TraceObserver::kStatic:
      k.energy = rest, k.radial = rest * c;
      break;
    case TraceObserver::kOutgoing:
      if (k.region == Region::kII) k.region = Region::kIV;
      k.energy = 1 + s * c, k.radial = c + s;
      break;
    case TraceObserver::kTwo:
      k.energy = -rest * c, k.radial = -rest;
      break;
    case TraceObserver::kFour:
      k.region = Region::kIV;
      k.energy = -rest * c, k.radial = rest;
      break;
  }
  return k;
}

// Finds the slope of phi over delta by a four-point difference, continued oddly through the axis.
double integrated_slope(const RayRequest& q, const NullRay& ray, double delta, double doppler,
                        Integrator integrator, double tolerance) {
  const double h = 1e-2 * smooth_over(ray) / doppler;
  const auto phi = [&](double steps) {
    const double at = delta + steps * h;
    const double folded = at < 0 ? -at : at > std::numbers::pi ? 2 * std::numbers::pi - at : at;
    const double swept =
        integrate_ray(photon_at(q.observer, q.at, folded), integrator, tolerance).phi;
    return folded == at ? swept : -swept;
  };
  return (8 * (phi(1) - phi(-1)) - (phi(2) - phi(-2))) / (12 * h);
}

TracedRay integrate_request(const RayRequest& q, Integrator integrator,
                            const TraceOptions& options) {
  const View view = view_of(q.observer);
  const NullRay ray = ray_of(q, view);
  const Seen at_observer = seen(ray, view);
  const double delta = q.edge ? at_observer.delta : static_cast<double>(q.delta);
  const PhotonAtObserver photon = photon_at(q.observer, q.at, delta);
  const IntegratedRay end = integrate_ray(photon, integrator, options.tolerance);
  TracedRay traced{
      delta, end.origin.value_or(SkyRegion::kIV), end.origin.has_value(), end.phi, kNone, kNone,
      kNone};
  if (!traced.decided) return traced;
  if (traced.origin != SkyRegion::kIV) traced.one_plus_z = std::abs(photon.energy);
  if (!options.slope) return traced;
  traced.slope =
      integrated_slope(q, ray, delta, at_observer.doppler, integrator, options.tolerance);
  set_amplification(traced, at_observer.sine);
  return traced;
}

}  // namespace

bool has_edge(TraceObserver observer, const Radius& at, Edge edge) {
  const bool inside = at.above_horizon <= 0;
  if (edge == Edge::kRegionThree)
    return inside && (observer == TraceObserver::kRain || observer == TraceObserver::kTwo);
  return observer != TraceObserver::kFour && !(observer == TraceObserver::kOutgoing && inside);
}

double edge_delta(TraceObserver observer, const Radius& at, Edge edge) {
  const View view = view_of(observer);
  const double tangent = tan_half_critical(at, critical_of(view, edge)) / kappa(at, view.frame);
  return 2 * (view.from_behind ? std::atan2(1.0, tangent) : std::atan(tangent));
}

TracedRay trace_ray(const RayRequest& q, TraceMethod method, const TraceOptions& options) {
  if (is_integrator(method)) return integrate_request(q, integrator_of(method), options);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const View view = view_of(q.observer);
  const NullRay ray = ray_of(q, view);
  const Seen at_observer = seen(ray, view);
  const double delta = q.edge ? at_observer.delta : static_cast<double>(q.delta);
  TracedRay traced{delta, origin_of(ray), true, 0, kNone, 0, 0};
  const bool from_sky = traced.origin != SkyRegion::kIV;
  if (from_sky) traced.one_plus_z = one_plus_z(ray) / at_observer.doppler;
  const double sign = view.from_behind ? -1 : 1;
  const bool radial = ray.sin_half == 0 || ray.cos_half == 0;
  if (circles_for_ever(ray) || (radial && !from_sky)) {
    // phi diverges, or starts from the axis like the cube root of the angle.
    traced.phi = radial ? 0 : kInfinite;
    traced.slope = kInfinite;
    return traced;
  }
  const Sweep sweep = method == TraceMethod::kTable
                          ? by_table(ray, traced.origin, options.table_bits)
                          : Sweep{exact_azimuth(ray), exact_slope(ray)};
  traced.phi = sweep.phi;
  traced.slope = sign * sweep.slope * at_observer.doppler;
  set_amplification(traced, at_observer.sine);
  return traced;
}

std::optional<TracedPlace> trace_place(const RayRequest& q, double psi, TraceMethod method,
                                       const TraceOptions& options) {
  const View view = view_of(q.observer);
  const NullRay ray = ray_of(q, view);
  if (is_integrator(method)) {
    if (psi == 0) return TracedPlace{q.at.r, 0};
    const double delta = q.edge ? seen(ray, view).delta : static_cast<double>(q.delta);
    const IntegratedRay there = integrate_ray_to(psi, photon_at(q.observer, q.at, delta),
                                                 integrator_of(method), options.tolerance);
    if (!(there.r > 0)) return std::nullopt;
    return TracedPlace{there.r, ray.outgoing ? there.passed.u : there.passed.v};
  }
  RayOrbits orbits;
  orbits.set(q.at, ray.outgoing, {&ray.sin_half, &ray.cos_half, &ray.gap_first, &ray.gap_second},
             1);
  RayPlaces places;
  orbits.find(&psi, places);
  TracedPlace place{places.r[0], 0};
  RayTimes(orbits).find(&psi, places, &place.null_time);
  if (method == TraceMethod::kExact || psi == 0) {
    const std::optional<double> exact = exact_position(ray, psi);
    if (!exact) return std::nullopt;
    place.r = *exact;
  }
  if (!(place.r > 0 && std::isfinite(place.r))) return std::nullopt;
  return place;
}

}  // namespace domefall
