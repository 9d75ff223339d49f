#include "pipeline/program/python/ray_arrays.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/program/python/arguments.h"
#include "pipeline/program/python/record_array.h"

namespace py = pybind11;

namespace domefall {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

py::module_ numpy() { return py::module_::import("numpy"); }

std::vector<std::string> texts(const py::handle& array) {
  std::vector<std::string> all;
  for (const py::handle element : array.attr("ravel")().attr("tolist")())
    all.push_back(utf8_text(py::str(element)));
  return all;
}

// Decimals are the elements of an array of numbers, or of decimals in text.
class Decimals {
 public:
  Decimals(const py::array& array, const char* name) : name_(name) {
    const char kind = array.dtype().kind();
    if (kind == 'U' || kind == 'S' || kind == 'O')
      texts_ = kind == 'S' ? texts(array.attr("astype")("U")) : texts(array);
    else if (kind == 'f' || kind == 'i' || kind == 'u')
      numbers_ = py::array_t<long double, py::array::c_style | py::array::forcecast>(array);
    else
      throw py::type_error(fmt::format("{} must be real numbers or decimals in text, got {}", name,
                                       std::string(py::str(array.dtype()))));
  }

  long double number(std::size_t k) const {
    return texts_.empty() ? numbers_.data()[k] : decimal_number(texts_[k], name_);
  }

  bool is_given(std::size_t k) const {
    return texts_.empty() ? !std::isnan(numbers_.data()[k]) : !texts_[k].empty();
  }

  // A double stands for its exact value, so its distances from 2 and 3 are exact.
  Radius radius(std::size_t k) const {
    return texts_.empty() ? Radius(numbers_.data()[k]) : decimal_radius(texts_[k]);
  }

 private:
  const char* name_;
  std::vector<std::string> texts_;
  py::array_t<long double> numbers_;
};

// Returns "ray [2, 5]: " for the element of that number in an array of that shape.
std::string place_of(std::size_t k, const std::vector<py::ssize_t>& shape) {
  std::vector<std::size_t> indices(shape.size());
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    const auto length = static_cast<std::size_t>(shape[axis]);
    indices[axis] = k % length;
    k /= length;
  }
  return indices.empty() ? std::string() : fmt::format("ray [{}]: ", fmt::join(indices, ", "));
}

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
    const py::sequence all = numpy().attr("broadcast_arrays")(
        given.r, or_else(given.delta, py::float_(kNone)), or_else(given.edge, py::str("")),
        or_else(given.offset, py::float_(0.0)), given.observer);
    const auto array = [&](std::size_t k) { return py::array(all[k]); };
    shape.assign(array(0).shape(), array(0).shape() + array(0).ndim());
    const Decimals radii(array(0), "r"), deltas(array(1), "delta"), offsets(array(3), "offset");
    edges = texts(all[2]);
    observers = texts(all[4]);
    for (std::size_t k = 0; k < edges.size(); ++k) add(k, radii, deltas, offsets);
  }

  std::vector<py::ssize_t> shape;
  std::vector<std::string> edges, observers;
  std::vector<RayRequest> requests;

 private:
  void add(std::size_t k, const Decimals& radii, const Decimals& deltas, const Decimals& offsets) {
    try {
      const TraceObserver observer = trace_observer(observers[k]);
      const Radius at = radii.radius(k);
      if (edges[k].empty()) {
        requests.push_back(ray_at_angle(observer, at, deltas.number(k)));
        return;
      }
      requests.push_back(
          ray_at_edge(observer, at, edges[k], static_cast<double>(offsets.number(k))));
      if (deltas.is_given(k)) require_delta(requests.back(), deltas.number(k));
    } catch (const InputError& error) {
      throw InputError(place_of(k, shape) + error.what());
    }
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
