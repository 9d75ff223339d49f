#include "pipeline/program/python/ray_arrays.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/program/python/arguments.h"
#include "pipeline/program/python/decimals.h"
#include "pipeline/program/python/record_array.h"

namespace py = pybind11;

namespace domefall {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// GivenRays are all that was given, broadcast to one shape.
class GivenRays {
 public:
  explicit GivenRays(const RayArrays& given) {
    if (given.delta.is_none() && given.edge.is_none())
      throw InputError("a ray takes delta, or an edge and perhaps an offset from it");
    if (given.edge.is_none() && !given.offset.is_none())
      throw InputError("offset is given without an edge");
    const auto or_else = [](const py::object& value, const py::object& other) {
      return value.is_none() ? other : value;
    };
    const std::vector<py::array> all = broadcast(
        {given.r, or_else(given.delta, py::float_(kNone)), or_else(given.edge, py::str("")),
         or_else(given.offset, py::float_(0.0)), given.observer});
    shape = shape_of(all[0]);
    const Decimals radii(all[0], "r"), deltas(all[1], "delta"), offsets(all[3], "offset");
    edges = texts(all[2]);
    observers = texts(all[4]);
    each_ray(edges.size(), shape,
             [&](std::size_t k) { requests.push_back(ray(k, radii, deltas, offsets)); });
  }

  std::vector<py::ssize_t> shape;
  std::vector<std::string> edges, observers;
  std::vector<RayRequest> requests;

 private:
  RayRequest ray(std::size_t k, const Decimals& radii, const Decimals& deltas,
                 const Decimals& offsets) const {
    const TraceObserver observer = trace_observer(observers[k]);
    const Radius at = radii.radius(k);
    if (edges[k].empty()) return ray_at_angle(observer, at, deltas.number(k));
    const RayRequest request =
        ray_at_edge(observer, at, edges[k], static_cast<double>(offsets.number(k)));
    if (deltas.is_given(k)) require_delta(request, deltas.number(k));
    return request;
  }
};

std::vector<RecordColumn> ray_record() {
  using enum CellKind;
  return {{"observer", kText},       {"r", kNumber},          {"delta", kNumber},
          {"edge", kText},           {"offset", kNumber},     {"origin", kText},
          {"phi", kNumber},          {"one_plus_z", kNumber}, {"slope", kNumber},
          {"amplification", kNumber}};
}

}  // namespace

py::array trace_arrays(const RayArrays& rays, const std::string& method, double tolerance) {
  constexpr double kFinest = 1e-13, kCoarsest = 1e-3;
  if (!(tolerance >= kFinest && tolerance <= kCoarsest))
    throw InputError(fmt::format("tolerance must be from 1e-13 to 1e-3, got {}", tolerance));
  const TraceMethod by = trace_method(method);
  const GivenRays given(rays);
  RecordArray records(ray_record(), given.shape);
  interruptible([&](const std::atomic<bool>& stop) {
    TraceOptions options;
    options.tolerance = tolerance;
    for (std::size_t k = 0; k < records.size() && !stop; ++k) {
      const RayRequest& q = given.requests[k];
      const TracedRay ray = trace_ray(q, by, options);
      records.start(k);
      records.add(std::string_view(given.observers[k]));
      records.add(q.at.r);
      records.add(ray.delta);
      records.add(std::string_view(given.edges[k]));
      records.add(q.edge ? q.offset : kNone);
      records.add(std::string_view(ray.decided ? name_of(ray.origin) : ""));
      for (const double value : {ray.phi, ray.one_plus_z, ray.slope, ray.amplification})
        records.add(value);
    }
  });
  return records.array();
}

}  // namespace domefall
