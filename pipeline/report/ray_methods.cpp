#include "pipeline/report/ray_methods.h"

namespace domefall {

std::vector<RayMethod> ray_methods(bool) {
  return {
      {"table", TraceMethod::kTable, "", {0}, 0, true},
      {"exact", TraceMethod::kExact, "", {0}, 0, false},
  };
}

TracedRay trace_by(const RayMethod& method, double, const RayRequest& request) {
  return trace_ray(request, method.method);
}

}  // namespace domefall
