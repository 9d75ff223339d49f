#include "pipeline/report/ray_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipeline/base/stop_watch.h"
#include "pipeline/light/charged_lens.h"
#include "pipeline/light/kerr_chart.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/wormhole_lens.h"
#include "pipeline/render/rays/view_tracer.h"

namespace domefall {
namespace {

struct Pass {
  std::vector<FollowedRay> rays;
  double ns;
};

// Follows all rays of a group, one after another, and times the whole by the wall clock.  A single
// ray is too short for the clock.
Pass trace_group(const RayGroup& group, const RayMethod& method, double setting) {
  Pass pass;
  // The memory is taken before the clock starts.
  pass.rays.reserve(group.size());
  const StopWatch watch;
  for (const SampleRay& ray : group) pass.rays.push_back(method.follow(ray.request, setting));
  pass.ns = 1e9 * watch.seconds();
  return pass;
}

double worst(const std::vector<double>& sorted) { return sorted.empty() ? 0 : sorted.back(); }

// Returns the least of the values that at least 99 of 100 do not exceed.
double percentile_99(const std::vector<double>& sorted) {
  if (sorted.empty()) return 0;
  const auto count = static_cast<double>(sorted.size());
  return sorted[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Errors collects what one method does wrong with many rays.
struct Errors {
  std::vector<double> phi, sky;
  int undecided = 0;

  void add(const FollowedRay& followed, const SampleRay& truth) {
    // A ray of a wrong origin has the azimuth of another path, which says nothing of the method's
    // accuracy.
    if (followed.origin != truth.origin || !std::isfinite(followed.phi)) {
      ++undecided;
      return;
    }
    const double off = std::abs(followed.phi - truth.phi) + (followed.place - truth.place).length();
    phi.push_back(off / std::max(1.0, truth.phi));
    sky.push_back(off / std::abs(truth.slope));  // d phi/d delta turns phi into delta
  }
  void sort() {
    std::sort(phi.begin(), phi.end());
    std::sort(sky.begin(), sky.end());
  }
};

// ---- a Schwarzschild hole ----

// Returns what trace_ray() finds, without what the report does not compare.
FollowedRay follow(const AnyRay& q, TraceMethod method, const TraceOptions& options) {
  const TracedRay ray = trace_ray(std::get<RayRequest>(q), method, options);
  return {ray.decided ? std::optional(ray.origin) : std::nullopt, ray.phi};
}

// Follows a ray by tables of 2^bits intervals to the octave.  The setting is a double here, like
// that of any method.
FollowedRay by_table(const AnyRay& q, double bits) {
  TraceOptions options;
  options.table_bits = static_cast<int>(bits);
  return follow(q, TraceMethod::kTable, options);
}

FollowedRay by_integral(const AnyRay& q, double) { return follow(q, TraceMethod::kExact, {}); }

FollowedRay by_steps(const AnyRay& q, TraceMethod method, double tolerance) {
  TraceOptions options;
  options.tolerance = tolerance;
  options.slope = false;  // an integrator would follow four more rays to find it
  return follow(q, method, options);
}

// ---- charges and wormholes ----

// A ZoneTables holds the tables of the zones of one observer's view.
struct ZoneTables {
  AnyRay observer;  // a ray of his
  double bits = 0;
  std::vector<std::pair<SkyRegion, SkyTable>> of;
};

bool is_same_observer(const AnyRay& a, const AnyRay& b) {
  if (a.index() != b.index()) return false;
  if (const auto* charged = std::get_if<ChargedRequest>(&a)) {
    const auto& other = std::get<ChargedRequest>(b);
    return charged->hole == other.hole && charged->at.r == other.at.r;
  }
  const auto &one = std::get<WormholeRequest>(a), &other = std::get<WormholeRequest>(b);
  return one.wormhole == other.wormhole && one.l == other.l;
}

HoleOptics optics_of(const AnyRay& ray) {
  ObserverState observer;
  if (const auto* charged = std::get_if<ChargedRequest>(&ray)) {
    observer.r = charged->at.r;
    observer.region = charged->at.above_outer > 0   ? Region::kI
                      : charged->at.above_inner > 0 ? Region::kII
                                                    : Region::kV;
    return make_charged_optics(charged->hole, observer);
  }
  const auto& within = std::get<WormholeRequest>(ray);
  observer.l = within.l, observer.r = within.wormhole.radius(within.l);
  return make_wormhole_optics(within.wormhole, observer);
}

const ZoneTables& kept_tables(const AnyRay& ray, double bits) {
  thread_local ZoneTables kept;
  if (kept.of.empty() || kept.bits != bits || !is_same_observer(kept.observer, ray)) {
    kept = {ray, bits, {}};
    // The observer's own sky comes first.
    for (const SkyPart& part : optics_of(ray).parts)
      kept.of.emplace_back(kept.of.empty() ? SkyRegion::kI : SkyRegion::kIII,
                           SkyTable(part.zone, static_cast<int>(bits)));
  }
  return kept;
}

// Returns how far a ray is from the edge of a zone, negative beyond it.
double from_edge(const AnyRay& ray, const SkyZone& zone) {
  const auto* charged = std::get_if<ChargedRequest>(&ray);
  const double offset = charged ? charged->offset : std::get<WormholeRequest>(ray).offset;
  if (!charged || charged->edge == (zone.edge.sign > 0 ? Critical::kFirst : Critical::kSecond))
    return 2 * std::tan(zone.edge.sign * offset / 4);
  const auto half = static_cast<double>(charged->delta / 2);
  return zone.edge.distance(std::sin(half), std::cos(half));
}

FollowedRay by_zone_table(const AnyRay& ray, double bits) {
  for (const auto& [sky, table] : kept_tables(ray, bits).of) {
    const double x = std::min(from_edge(ray, table.zone()), table.x_max());
    // Frames take the slope, too.
    if (x > 0 && table.slope(x) > 0) return {sky, table.azimuth(x)};
  }
  return {std::nullopt, 0};
}

FollowedRay by_swept_integral(const AnyRay& ray, double) {
  if (const auto* within = std::get_if<WormholeRequest>(&ray)) {
    const TracedWormhole traced = trace_wormhole(*within, false);
    return {traced.own ? SkyRegion::kI : SkyRegion::kIII, traced.azimuth};
  }
  const TracedCharge traced = trace_charge(std::get<ChargedRequest>(ray));
  if (traced.origin == ChargedOrigin::kOwn) return {SkyRegion::kI, traced.phi};
  if (traced.origin == ChargedOrigin::kParallel) return {SkyRegion::kIII, traced.phi};
  return {std::nullopt, 0};
}

FollowedRay by_light_steps(const AnyRay& ray, FallMethod method, double tolerance) {
  if (const auto* within = std::get_if<WormholeRequest>(&ray))
    return step_wormhole_ray(*within, method, tolerance);
  return step_charged_ray(std::get<ChargedRequest>(ray), method, tolerance);
}

// ---- a spin ----

FollowedRay by_exact_spin(const AnyRay& of, double) {
  const auto& ray = std::get<SpinRequest>(of);
  const TracedKerr traced = trace_kerr(ray.at, ray.direction);
  if (traced.origin == KerrOrigin::kPastHorizon) return {std::nullopt, 0};
  return {traced.origin == KerrOrigin::kOwn ? SkyRegion::kI : SkyRegion::kIII, 0, traced.sky};
}

// Frames know a direction by its angles alone, and its distance from an edge by their difference.
FollowedRay by_chart(const AnyRay& of, double) {
  const auto& ray = std::get<SpinRequest>(of);
  thread_local std::vector<KerrChart> kept;
  if (kept.empty() || kept[0].at() != ray.at) {
    kept.clear();
    kept.emplace_back(ray.at, KerrEdge::kSilhouette);
    if (ray.at.delta() < 0) kept.emplace_back(ray.at, KerrEdge::kRegionThree);
  }
  const auto delta = static_cast<double>(ray.direction.delta);
  const auto eta = static_cast<double>(ray.direction.eta);
  for (const KerrChart& chart : kept) {
    const bool own = chart.sky() == KerrEdge::kSilhouette;
    const KerrChart::Edge edge = chart.edge(eta);
    if (own ? delta > edge.delta : delta < edge.delta)
      return {own ? SkyRegion::kI : SkyRegion::kIII, 0, chart.place(delta, eta, edge).sky};
  }
  return {std::nullopt, 0};
}

FollowedRay by_mino_steps(const AnyRay& ray, FallMethod method, double tolerance) {
  return step_ray_over_mino_time(std::get<SpinRequest>(ray), method, tolerance);
}

FollowedRay by_kerr_schild_steps(const AnyRay& ray, FallMethod method, double tolerance) {
  return step_kerr_schild_ray(std::get<SpinRequest>(ray), method, tolerance);
}

// Returns the bits of the tables to compare.  The error falls with the eighth power of the
// intervals' width (octave_curve.h), so each bit divides it by up to 256.  Two bits beyond the
// default are enough to show where rounding takes over.
std::vector<double> table_bits(bool quick) {
  constexpr int kDefault = OctaveCurve::kPerOctaveBits;
  if (quick) return {1, kDefault};
  return {0, 1, 2, kDefault, kDefault + 1, kDefault + 2};
}

const double kDefaultTolerance = TraceOptions{}.tolerance;

// Returns the tolerances of a step, from coarse to fine, the order that the accuracy page relies
// on.  The last is the finest that integrate_ray() takes.
std::vector<double> tolerances(bool quick) {
  if (quick) return {1e-5, kDefaultTolerance};
  return {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
}

struct Observer {
  const char* name;
  Region region;
  Tetrad tetrad;
  double r;
};
constexpr std::array kObservers{
    Observer{"region I, free fall at 10 M", Region::kI, Tetrad::kRain, 10},
    Observer{"region II, free fall at 0.5 M", Region::kII, Tetrad::kRain, 0.5},
    Observer{"region IV, outward at 1 M", Region::kIV, Tetrad::kOutgoing, 1}};

// A dome of this size has some 51,000 pixels, pi/4 of its square, which are 400 full batches.  Each
// pass traces all of them.
constexpr int kSize = 256, kPasses = 7;

// Returns the time of one view ray.  The quickest pass counts, because whatever else the machine
// does can only lengthen a pass.
double nanoseconds(const Observer& observer) {
  FrameState state;
  state.projection = Domemaster{kSize};
  state.observer.spacetime = Schwarzschild{};
  state.observer.region = observer.region;
  state.observer.tetrad = observer.tetrad;
  state.observer.r = observer.r;
  // Every sky that the observer sees has a table, so every view ray is looked up in one.
  const ViewTracer tracer(state, WantedSkies{{true, true, true}});
  // The directions are collected first, so that tracing alone is timed.
  std::vector<CameraDirection> directions;
  for (int row = 0; row < kSize; ++row) {
    const ColumnRange inside = inside_columns(state.projection, row);
    for (int i = inside.first; i <= inside.last; ++i)
      directions.push_back(direction_at(state.projection, {i + 1.0, row + 1.0}));
  }
  ViewRayBatch batch;
  double best = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    const StopWatch watch;
    for (std::size_t k = 0; k < directions.size(); k += ViewRayBatch::kSize) {
      const auto count =
          static_cast<int>(std::min<std::size_t>(ViewRayBatch::kSize, directions.size() - k));
      tracer.trace(directions.data() + k, count, batch);
    }
    best = std::min(best, 1e9 * watch.seconds());
  }
  return best / static_cast<double>(directions.size());
}

}  // namespace

RayErrorRow measure_class(const RayClass& of, const std::vector<RayGroup>& groups,
                          const RayMethod& method, double setting, int repeats) {
  Errors errors;
  double trace_ns = 0;
  std::vector<double> build_ns;
  std::size_t rays = 0;
  for (const RayGroup& group : groups) {
    // The first pass also builds the tables of this radius, so what it takes beyond the best pass
    // is the time of building.
    const Pass first = trace_group(group, method, setting);
    for (std::size_t k = 0; k < group.size(); ++k) errors.add(first.rays[k], group[k]);
    // Without repeats the first pass counts as it is, and no time is left for the building.
    double best = repeats > 0 ? std::numeric_limits<double>::infinity() : first.ns;
    for (int k = 0; k < repeats; ++k) best = std::min(best, trace_group(group, method, setting).ns);
    trace_ns += best;
    build_ns.push_back(method.keeps_tables ? first.ns - best : 0);
    rays += group.size();
  }
  errors.sort();
  constexpr double kPerMicrosecond = 1e-3;
  return {of.region,
          of.name,
          method.name,
          setting,
          setting == method.default_setting,
          static_cast<int>(rays),
          errors.undecided,
          worst(errors.phi),
          percentile_99(errors.phi),
          worst(errors.sky),
          percentile_99(errors.sky),
          trace_ns / static_cast<double>(rays),
          median(build_ns) * kPerMicrosecond};
}

std::vector<RayErrorRow> measure_rays(bool quick) {
  std::vector<RayErrorRow> rows;
  for (const RayClass& of : ray_classes()) {
    // About a spin the truth of a ray takes 20 ms, its steps up to 40, and the chart of a place half a second.
    const bool few = of.kind == RayKind::kSpin;
    const int radii = few ? (quick ? 2 : 12) : quick ? 6 : 24;
    // Of 960 rays in a class 9 may exceed the error of 99 of 100, and one of 120.
    const int per_radius = quick ? 8 : few ? 10 : 40, repeats = quick || few ? 1 : 3;
    const std::vector<RayGroup> groups = sample_rays(of, radii, per_radius);
    for (const RayMethod& method : compared_methods(of.kind, quick))
      for (const double setting : method.settings)
        rows.push_back(measure_class(of, groups, method, setting, repeats));
  }
  return rows;
}

std::vector<RayMethod> compared_methods(RayKind kind, bool quick) {
  const bool hole = kind == RayKind::kHole, spin = kind == RayKind::kSpin;
  std::vector<RayMethod> methods{{"table", "bits", table_bits(quick), OctaveCurve::kPerOctaveBits,
                                  true, hole ? by_table : by_zone_table},
                                 {"exact",
                                  "",
                                  {0},
                                  0,
                                  false,
                                  hole   ? by_integral
                                  : spin ? by_exact_spin
                                         : by_swept_integral}};
  if (spin) methods[0] = {"chart", "", {0}, 0, true, by_chart};
  const auto add = [&](std::string_view name, const auto& steps, auto method) {
    methods.push_back(
        {std::string(name), "tolerance", tolerances(quick), kDefaultTolerance, false,
         [=](const AnyRay& q, double tolerance) { return steps(q, method, tolerance); }});
  };
  if (hole) {
    for (const auto& [name, method] : kTraceMethods)
      if (is_integrator(method)) add(name, by_steps, method);
    return methods;
  }
  if (spin) {
    add("mino-dopri5", by_mino_steps, FallMethod::kDopri5);
    add("mino-rkf78", by_mino_steps, FallMethod::kFehlberg78);
    add("kerr-schild-dopri5", by_kerr_schild_steps, FallMethod::kDopri5);
    add("kerr-schild-rkf78", by_kerr_schild_steps, FallMethod::kFehlberg78);
    return methods;
  }
  const std::string of = kind == RayKind::kCharge ? "binet-" : "";
  add(of + "dopri5", by_light_steps, FallMethod::kDopri5);
  add(of + "rkf78", by_light_steps, FallMethod::kFehlberg78);
  return methods;
}

std::vector<ViewRaySpeedRow> measure_view_ray_speed() {
  std::vector<ViewRaySpeedRow> rows;
  rows.reserve(kObservers.size());
  for (const Observer& observer : kObservers)
    rows.push_back({observer.name, nanoseconds(observer)});
  return rows;
}

}  // namespace domefall
