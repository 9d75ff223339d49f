#include "pipeline/report/compared_methods.h"

namespace domefall {
namespace {

// Returns what trace_ray() finds, without what the report does not compare.
FollowedRay follow(const RayRequest& q, TraceMethod method, const TraceOptions& options) {
  const TracedRay ray = trace_ray(q, method, options);
  return {ray.decided ? std::optional(ray.origin) : std::nullopt, ray.phi};
}

// Follows a ray by tables of 2^bits intervals to the octave.  The setting is a double here, like
// that of any method.
FollowedRay by_table(const RayRequest& q, double bits) {
  TraceOptions options;
  options.table_bits = static_cast<int>(bits);
  return follow(q, TraceMethod::kTable, options);
}

FollowedRay by_integral(const RayRequest& q, double) { return follow(q, TraceMethod::kExact, {}); }

FollowedRay by_steps(const RayRequest& q, TraceMethod method, double tolerance) {
  TraceOptions options;
  options.tolerance = tolerance;
  options.slope = false;  // an integrator would follow four more rays to find it
  return follow(q, method, options);
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

}  // namespace

std::vector<RayMethod> compared_methods(bool quick) {
  std::vector<RayMethod> methods{
      {"table", "bits", table_bits(quick), OctaveCurve::kPerOctaveBits, true, by_table},
      {"exact", "", {0}, 0, false, by_integral}};
  for (const auto& [name, method] : kTraceMethods)
    if (is_integrator(method))  // the two others stand in the list already
      methods.push_back({name, "tolerance", tolerances(quick), kDefaultTolerance, false,
                         [method = method](const RayRequest& q, double tolerance) {
                           return by_steps(q, method, tolerance);
                         }});
  return methods;
}

}  // namespace domefall
