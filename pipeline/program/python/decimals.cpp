#include "pipeline/program/python/decimals.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/light/kerr_request.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/program/python/arguments.h"

namespace py = pybind11;

namespace domefall {

std::vector<std::string> texts(const py::handle& array) {
  std::vector<std::string> all;
  for (const py::handle element : array.attr("ravel")().attr("tolist")())
    all.push_back(utf8_text(py::str(element)));
  return all;
}

Decimals::Decimals(const py::array& array, const char* name) : name_(name) {
  const char kind = array.dtype().kind();
  if (kind == 'U' || kind == 'S' || kind == 'O')
    texts_ = kind == 'S' ? texts(array.attr("astype")("U")) : texts(array);
  else if (kind == 'f' || kind == 'i' || kind == 'u')
    numbers_ = py::array_t<long double, py::array::c_style | py::array::forcecast>(array);
  else
    throw py::type_error(fmt::format("{} must be real numbers or decimals in text, got {}", name,
                                     std::string(py::str(array.dtype()))));
}

long double Decimals::number(std::size_t k) const {
  return texts_.empty() ? numbers_.data()[k] : decimal_number(texts_[k], name_);
}

bool Decimals::is_given(std::size_t k) const {
  return texts_.empty() ? !std::isnan(numbers_.data()[k]) : !texts_[k].empty();
}

Radius Decimals::radius(std::size_t k) const {
  return texts_.empty() ? Radius(numbers_.data()[k]) : decimal_radius(texts_[k]);
}

long double Decimals::rest(std::size_t k) const {
  return texts_.empty() ? 0 : lost_digits(texts_[k]);
}

namespace {

std::string place_of(std::size_t k, const std::vector<py::ssize_t>& shape) {
  std::vector<std::size_t> indices(shape.size());
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    const auto length = static_cast<std::size_t>(shape[axis]);
    indices[axis] = k % length;
    k /= length;
  }
  return indices.empty() ? std::string() : fmt::format("ray [{}]: ", fmt::join(indices, ", "));
}

}  // namespace

void each_ray(std::size_t count, const std::vector<py::ssize_t>& shape,
              const std::function<void(std::size_t)>& ray) {
  for (std::size_t k = 0; k < count; ++k) {
    try {
      ray(k);
    } catch (const InputError& error) {
      throw InputError(place_of(k, shape) + error.what());
    }
  }
}

std::vector<py::array> broadcast(const std::vector<py::object>& values) {
  py::tuple arguments(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) arguments[k] = values[k];
  std::vector<py::array> all;
  for (const py::handle one : py::module_::import("numpy").attr("broadcast_arrays")(*arguments))
    all.emplace_back(py::reinterpret_borrow<py::array>(one));
  return all;
}

std::vector<py::ssize_t> shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

}  // namespace domefall
