// This file traces rays near holes that spin or are charged, and in wormholes, for Python by arrays of
// numpy.
#pragma once

#include <pybind11/numpy.h>

#include <string>

namespace domefall {

// Each is a number, a text, an array of these or None, and all are broadcast against each other.
struct SpinArrays {
  pybind11::object r, delta, spin, charge, theta, eta, edge, offset;
};
struct WormholeArrays {
  pybind11::object l, delta, profile, rho, a, m, edge, offset;
};

// Trace each ray as `domefall trace --table` does, and return records in the shape of the broadcast
// arrays.  Numbers are NaN where there is nothing, and offset where no edge was given.  Throw InputError,
// which names the element, for what is no ray, and pybind11::type_error for arrays of other kinds.
pybind11::array trace_spin_arrays(const SpinArrays& rays);
// The method is table or exact.
pybind11::array trace_wormhole_arrays(const WormholeArrays& rays, const std::string& method);

}  // namespace domefall
