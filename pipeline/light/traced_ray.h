// trace_ray() gives one ray by numbers, for an observer at rest in one of the named frames.
// `domefall trace` prints this, and the reference rays are compared with it.
#pragma once

#include <array>
#include <optional>

#include "pipeline/light/null_ray.h"
#include "pipeline/light/octave_curve.h"

namespace domefall {

enum class TraceObserver {
  kRain,      // free fall from rest at infinity, in I and II
  kStatic,    // r > 2
  kOutgoing,  // free fall to rest at infinity: r > 2 in I, r <= 2 in IV
  kTwo,       // T_II: at rest in t inside the future horizon, r < 2
  kFour,      // T_IV: at rest in t inside the past horizon, r < 2
};

enum class TraceMethod {
  kTable,  // what renders frames
  kExact,
  // Integrators (integrated_ray.h) share no formula with the two above.
  kPaperRk4,     // [Riazuelo] sec. sec_cel1: adaptive RK4, Schwarzschild and Kruskal coordinates
  kFullDopri5,   // the same equations
  kFullRkf78,    // of order 8
  kBinetDopri5,  // d2w/dphi2 = 3 w^2 - w
  kBinetRkf78,
};

struct NamedTraceMethod {
  const char* name;
  TraceMethod method;
};
// The command line and the report call the methods by these names.
inline constexpr std::array kTraceMethods{
    NamedTraceMethod{"table", TraceMethod::kTable},
    NamedTraceMethod{"exact", TraceMethod::kExact},
    NamedTraceMethod{"rk4", TraceMethod::kPaperRk4},
    NamedTraceMethod{"dopri5", TraceMethod::kFullDopri5},
    NamedTraceMethod{"rkf78", TraceMethod::kFullRkf78},
    NamedTraceMethod{"binet-dopri5", TraceMethod::kBinetDopri5},
    NamedTraceMethod{"binet-rkf78", TraceMethod::kBinetRkf78}};

constexpr bool is_integrator(TraceMethod method) {
  return method != TraceMethod::kTable && method != TraceMethod::kExact;
}

// An Edge is one in delta, as the observer sees it.
enum class Edge {
  kSilhouette,   // of region I's sky; none in region IV
  kRegionThree,  // r <= 2, rain and T_II
};
bool has_edge(TraceObserver observer, const Radius& at, Edge edge);

// A RayRequest gives delta (radians) from -R, which is the direction of the hole outside.  If an
// edge is given, delta = edge + offset to full accuracy instead.
struct RayRequest {
  TraceObserver observer = TraceObserver::kRain;
  Radius at = 0.0;
  long double delta = 0;
  std::optional<Edge> edge;
  double offset = 0;
};

// Returns where that ray stands in delta, without following it, to check that it is one.
double edge_delta(TraceObserver observer, const Radius& at, Edge edge);

struct TracedRay {
  double delta;
  SkyRegion origin;
  bool decided;          // false: an integrator's steps ran out; origin and the rest mean nothing
  double phi;            // swept azimuth, radians; infinite for a ray that circles for ever
  double one_plus_z;     // emitted / observed frequency; NaN for rays from the past singularity
  double slope;          // d phi / d delta, signed, in the observer's frame
  double amplification;  // sin(delta)/|sin(phi) slope|
};

struct TraceOptions {
  int table_bits = OctaveCurve::kPerOctaveBits;  // of kTable; see OctaveCurve
  double tolerance = 1e-10;                      // of the integrators, relative, each step
  // Integrators find the slope by four further rays.  Without it, slope and amplification are NaN.
  bool slope = true;
};

// Traces a ray.  The tables are kept from one call to the next while the radius stays the same (in
// each thread).
TracedRay trace_ray(const RayRequest& q, TraceMethod method, const TraceOptions& options = {});

// A TracedPlace says where that ray is after having swept psi >= 0, and when its light was there.
struct TracedPlace {
  double r;  // units of M
  // This is the place's v less the observer's, or u in the outgoing frame and T_IV (ray_times.h),
  // in units of M.
  double null_time;
};

// Returns nothing where the ray has ended, or an integrator's steps ran out.  The table's method is
// RayOrbits, which needs no table.
std::optional<TracedPlace> trace_place(const RayRequest& q, double psi, TraceMethod method,
                                       const TraceOptions& options = {});

}  // namespace domefall
