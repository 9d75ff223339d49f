// This file takes numbers and texts from arrays of numpy that callers give, and broadcasts them.
#pragma once

#include <pybind11/numpy.h>

#include <functional>
#include <string>
#include <vector>

#include "pipeline/spacetime/radius.h"

namespace domefall {

// Returns the elements of an array as texts.
std::vector<std::string> texts(const pybind11::handle& array);

// Decimals are the elements of an array of numbers, or of decimals in text.
class Decimals {
 public:
  // Throws pybind11::type_error for arrays of other kinds.  `name` must outlive this object.
  Decimals(const pybind11::array& array, const char* name);

  // Throws InputError for a text that is no decimal number.
  long double number(std::size_t k) const;
  bool is_given(std::size_t k) const;
  // A double stands for its exact value, so its distances from 2 and 3 are exact.
  Radius radius(std::size_t k) const;
  // Returns what is lost of a decimal by rounding.
  long double rest(std::size_t k) const;

 private:
  const char* name_;
  std::vector<std::string> texts_;
  pybind11::array_t<long double> numbers_;
};

// Calls ray(k) for each of `count` elements in an array of that shape.  An InputError begins with "ray
// [2, 5]: " and the like.
void each_ray(std::size_t count, const std::vector<pybind11::ssize_t>& shape,
              const std::function<void(std::size_t)>& ray);

// Broadcasts values against each other.
std::vector<pybind11::array> broadcast(const std::vector<pybind11::object>& values);
std::vector<pybind11::ssize_t> shape_of(const pybind11::array& array);

}  // namespace domefall
