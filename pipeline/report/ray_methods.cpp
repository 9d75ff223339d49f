#include "pipeline/report/ray_methods.h"

namespace domefall {
namespace {

std::vector<double> table_bits(bool quick) {
  constexpr int kDefault = OctaveCurve::kPerOctaveBits;
  if (quick) return {1, kDefault};
  return {0, 1, 2, kDefault, kDefault + 1, kDefault + 2};
}

}  // namespace

std::vector<RayMethod> ray_methods(bool quick) {
  return {
      {"table", TraceMethod::kTable, "bits", table_bits(quick), OctaveCurve::kPerOctaveBits, true},
      {"exact", TraceMethod::kExact, "", {0}, 0, false},
  };
}

TracedRay trace_by(const RayMethod& method, double setting, const RayRequest& request) {
  TraceOptions options;
  if (method.method == TraceMethod::kTable) options.table_bits = static_cast<int>(setting);
  return trace_ray(request, method.method, options);
}

}  // namespace domefall
