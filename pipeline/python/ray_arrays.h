// Rays by numbers for Python, over numpy's arrays.
#pragma once

#include <pybind11/numpy.h>

#include <string>

namespace domefall {

// What a caller of `trace` gives: numbers, text or arrays of them, which are broadcast, or None.
struct RayArrays {
  pybind11::object r;         // M; as text its decimals are taken as they are
  pybind11::object delta;     // radians from -R; None where edge and offset are given
  pybind11::object edge;      // silhouette, region3, or empty for a ray that is given by delta
  pybind11::object offset;    // radians from the edge
  pybind11::object observer;  // the words of trace_observer
};

// Traces each as `domefall trace` does.  Returns records in the shape of the broadcast arrays, with
// the columns of `domefall trace`; delta is that of the ray also where an edge was given, offset is
// NaN where none was, and the last four are NaN where `domefall trace` has nothing.  `tolerance`
// (1e-13 to 1e-3) is that of integrators.  Throws InputError, which names the element, for what is
// no ray, and pybind11::type_error for arrays of other kinds.
pybind11::array trace_arrays(const RayArrays& rays, const std::string& method, double tolerance);

}  // namespace domefall
