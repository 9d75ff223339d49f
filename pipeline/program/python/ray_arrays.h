// This file traces rays for Python by arrays of numpy.
#pragma once

#include <pybind11/numpy.h>

#include <string>

namespace domefall {

// RayArrays are what a caller of `trace` gives.  Each is a number, a text, an array of these or
// None, and all are broadcast against each other.
struct RayArrays {
  pybind11::object r;         // M; as text its decimals are taken as they are
  pybind11::object delta;     // radians from -R; None where edge and offset are given
  pybind11::object edge;      // silhouette, region3, or empty for a ray that is given by delta
  pybind11::object offset;    // radians from the edge
  pybind11::object observer;  // the words of trace_observer
};

// Traces each ray as `domefall trace` does.  Returns records in the shape of the broadcast arrays,
// with the columns of `domefall trace`.  Of these, delta is the ray's own where an edge was given,
// too, offset is NaN where no edge was given, and the last four are NaN where `domefall trace` has
// nothing.  `tolerance` (1e-13 to 1e-3) is that of the integrators.  Throws InputError, which names
// the element, for what is no ray, and pybind11::type_error for arrays of other kinds.
pybind11::array trace_arrays(const RayArrays& rays, const std::string& method, double tolerance);

}  // namespace domefall
