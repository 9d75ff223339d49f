// This file makes the Python module domefall.
//
// It shows to Python what the program shows at the command line, by the same functions.  manual.h
// says what each of its names means, which help(domefall) prints.

#include <dlfcn.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <numbers>
#include <string>
#include <system_error>

#include "pipeline/base/errors.h"
#include "pipeline/light/traced_ray.h"
#include "pipeline/program/python/hole_arrays.h"
#include "pipeline/program/python/manual.h"
#include "pipeline/program/python/ray_arrays.h"
#include "pipeline/program/python/show_object.h"
#include "pipeline/show/assets.h"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace domefall {
namespace {

// Raises an exception whose message may hold a path that is not UTF-8.
void raise(PyObject* type, const char* message) {
  const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(message));
  if (text) PyErr_SetObject(type, text.ptr());
}

void define_errors(py::module_& module) {
  static PyObject* const input_error = PyErr_NewExceptionWithDoc(
      "domefall.InputError", manual::kInputError, PyExc_ValueError, nullptr);
  static PyObject* const temporary_error = PyErr_NewExceptionWithDoc(
      "domefall.TemporaryError", manual::kTemporaryError, PyExc_OSError, nullptr);
  if (!input_error || !temporary_error) throw py::error_already_set();
  module.attr("InputError") = py::handle(input_error);
  module.attr("TemporaryError") = py::handle(temporary_error);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise(input_error, error.what());
    } catch (const TemporaryError& error) {
      raise(temporary_error, error.what());
    } catch (const std::system_error& error) {
      raise(temporary_error, error.what());
    }
  });
}

// Looks for the program where an installation has it, because the assets are found beside it.
void find_assets() {
  Dl_info here{};
  if (dladdr(reinterpret_cast<const void*>(&find_assets), &here) == 0 || !here.dli_fname) return;
  std::error_code error;
  const fs::path file = fs::canonical(here.dli_fname, error);
  const fs::path program = file.parent_path() / DOMEFALL_PROGRAM_FROM_MODULE;
  if (!error) take_program_folder(program.lexically_normal());
}

// Returns the show of an object.  Throws for one that __new__ has made and whose __init__ was not
// called, because pybind11 would hand on memory in which there is no show.
ShowObject& show_of(const py::object& self) {
  if (!py::isinstance<ShowObject>(self))
    throw py::type_error("expected a domefall.Show, got " + std::string(py::repr(self)));
  auto* const instance = reinterpret_cast<py::detail::instance*>(self.ptr());
  if (!instance->get_value_and_holder().holder_constructed())
    throw py::type_error("this domefall.Show has no show: its __init__ was not called");
  return self.cast<ShowObject&>();
}

void define_show(py::module_& module) {
  using Self = const py::object&;
  py::class_<ShowObject>(module, "Show", manual::kShow)
      .def(py::init<const py::object&, const py::object&>(), py::arg("file"),
           py::arg("threads") = 0, manual::kShowInit)
      .def_property_readonly(
          "file", [](Self self) { return show_of(self).show().file; }, manual::kFile)
      .def_property_readonly(
          "title", [](Self self) { return show_of(self).show().title; }, manual::kTitle)
      .def_property_readonly(
          "frames", [](Self self) { return frame_count(show_of(self).show()); }, manual::kFrames)
      .def_property_readonly(
          "frames_per_second", [](Self self) { return show_of(self).show().frames_per_second; },
          manual::kFramesPerSecond)
      .def_property_readonly(
          "mass_solar",
          [](Self self) -> py::object {
            const auto mass = show_of(self).show().spacetime.solar_masses();
            if (!mass) return py::none();
            return py::float_(*mass);
          },
          manual::kMassSolar)
      .def_property_readonly(
          "projection",
          [](Self self) { return std::string(projection_name(show_of(self).show().projection)); },
          manual::projection().c_str())
      .def_property_readonly(
          "size",
          [](Self self) {
            const Projection& projection = show_of(self).show().projection;
            return py::make_tuple(columns(projection), rows(projection));
          },
          manual::kSize)
      .def(
          "states",
          [](Self self, const py::object& frames) { return show_of(self).states(frames); },
          py::arg("frames") = py::none(), manual::kStates)
      .def(
          "frame",
          [](Self self, const py::object& number, const py::object& size) {
            return show_of(self).frame(number, size);
          },
          py::arg("number"), py::arg("size") = py::none(), manual::kFrame)
      .def(
          "graded",
          [](Self self, const py::object& number, const py::object& size) {
            return show_of(self).graded(number, size);
          },
          py::arg("number"), py::arg("size") = py::none(), manual::kGraded)
      .def("__repr__", [](Self self) {
        const Show& show = show_of(self).show();
        return py::str("<domefall.Show {!r}: {} frames>").format(show.title, frame_count(show));
      });
}

void define_trace(py::module_& module) {
  const py::object none = py::none();
  module.def(
      "trace",
      [](py::object r, py::object delta, py::object edge, py::object offset, py::object observer,
         const std::string& method, double tolerance) {
        return trace_arrays({std::move(r), std::move(delta), std::move(edge), std::move(offset),
                             std::move(observer)},
                            method, tolerance);
      },
      py::arg("r"), py::arg("delta") = none, py::kw_only(), py::arg("edge") = none,
      py::arg("offset") = none, py::arg("observer") = "rain", py::arg("method") = "table",
      py::arg("tolerance") = TraceOptions{}.tolerance, manual::kTrace);
  module.def(
      "trace_spin",
      [](py::object r, py::object delta, py::object spin, py::object charge, py::object theta,
         py::object eta, py::object edge, py::object offset) {
        return trace_spin_arrays({std::move(r), std::move(delta), std::move(spin),
                                  std::move(charge), std::move(theta), std::move(eta),
                                  std::move(edge), std::move(offset)});
      },
      py::arg("r"), py::arg("delta") = none, py::kw_only(), py::arg("spin") = 0,
      py::arg("charge") = 0, py::arg("theta") = std::numbers::pi / 2, py::arg("eta") = 0,
      py::arg("edge") = none, py::arg("offset") = none, manual::kTraceSpin);
  module.def(
      "trace_wormhole",
      [](py::object l, py::object delta, py::object profile, py::object rho, py::object a,
         py::object m, py::object edge, py::object offset, const std::string& method) {
        return trace_wormhole_arrays(
            {std::move(l), std::move(delta), std::move(profile), std::move(rho), std::move(a),
             std::move(m), std::move(edge), std::move(offset)},
            method);
      },
      py::arg("l"), py::arg("delta") = none, py::kw_only(), py::arg("profile") = "ellis",
      py::arg("rho") = 1, py::arg("a") = none, py::arg("m") = none, py::arg("edge") = none,
      py::arg("offset") = none, py::arg("method") = "table", manual::kTraceWormhole);
}

}  // namespace
}  // namespace domefall

PYBIND11_MODULE(domefall, module) {
  using namespace domefall;
  py::options options;
  options.disable_function_signatures();  // the manual has them in the words of Python
  module.doc() = manual::kModule;
  module.attr("__version__") = DOMEFALL_VERSION;
  module.attr("SECONDS_PER_SOLAR_MASS") = kSecondsPerSolarMass;
  find_assets();
  define_errors(module);
  define_show(module);
  define_trace(module);
}
