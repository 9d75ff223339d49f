#include "pipeline/report/ray_errors.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace domefall {
namespace {

using SteadyClock = std::chrono::steady_clock;

double nanoseconds_since(SteadyClock::time_point start) {
  return std::chrono::duration<double, std::nano>(SteadyClock::now() - start).count();
}

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
  const SteadyClock::time_point start = SteadyClock::now();
  for (const SampleRay& ray : group) pass.rays.push_back(method.follow(ray.request, setting));
  pass.ns = nanoseconds_since(start);
  return pass;
}

double worst(const std::vector<double>& sorted) { return sorted.empty() ? 0 : sorted.back(); }

// Returns the least of the values that at least 99 of 100 do not exceed.
double percentile_99(const std::vector<double>& sorted) {
  if (sorted.empty()) return 0;
  const auto count = static_cast<double>(sorted.size());
  return sorted[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
}

// Returns the upper median of at least one value.
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
    const double off = std::abs(followed.phi - truth.phi);
    phi.push_back(off / std::max(1.0, truth.phi));
    sky.push_back(off / std::abs(truth.slope));  // d phi/d delta turns phi into delta
  }
  void sort() {
    std::sort(phi.begin(), phi.end());
    std::sort(sky.begin(), sky.end());
  }
};

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
  // The 24 radii have 960 rays in each class, of which 9 may exceed the error of 99 of 100.
  const int radii = quick ? 6 : 24, per_radius = quick ? 8 : 40, repeats = quick ? 1 : 3;
  std::vector<RayErrorRow> rows;
  for (const RayClass& of : ray_classes()) {
    const std::vector<RayGroup> groups = sample_rays(of, radii, per_radius);
    for (const RayMethod& method : compared_methods(quick))
      for (const double setting : method.settings)
        rows.push_back(measure_class(of, groups, method, setting, repeats));
  }
  return rows;
}

}  // namespace domefall
