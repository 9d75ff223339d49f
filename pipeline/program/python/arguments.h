// This file takes text and integers from arguments of Python, whatever they are, and does long work
// for Python without its lock, so that its other threads go on and Ctrl-C ends the work.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <string>

#include "pipeline/show/nearest_word.h"

namespace domefall {

// Returns a str as UTF-8.  What UTF-8 cannot hold, such as half of a surrogate pair, is escaped.
inline std::string utf8_text(const pybind11::handle& text) {
  const auto bytes = pybind11::reinterpret_steal<pybind11::bytes>(
      PyUnicode_AsEncodedString(text.ptr(), "utf-8", "backslashreplace"));
  if (!bytes) throw pybind11::error_already_set();
  return bytes;
}

// Returns the digits of an integer of Python or numpy, cut if there are very many (shown).  Raises
// TypeError for anything else, a bool too.
inline std::string digits_of(const pybind11::handle& value) {
  // numpy's own bool has an index in some versions.
  const auto type = value.get_type().attr("__name__").cast<std::string>();
  if (PyBool_Check(value.ptr()) || type == "bool" || type == "bool_")
    throw pybind11::type_error("expected an integer, got " + utf8_text(pybind11::str(value)));
  const auto whole = pybind11::reinterpret_steal<pybind11::object>(PyNumber_Index(value.ptr()));
  if (!whole) throw pybind11::error_already_set();
  // Beyond some thousands of digits Python writes numbers by a base of 16 only.
  constexpr std::size_t kManyBits = 8192;
  const int base =
      pybind11::int_(whole.attr("bit_length")()).cast<std::size_t>() > kManyBits ? 16 : 10;
  const auto digits =
      pybind11::reinterpret_steal<pybind11::object>(PyNumber_ToBase(whole.ptr(), base));
  if (!digits) throw pybind11::error_already_set();
  return shown(utf8_text(digits));
}

// Runs work(stop) in a thread of its own and returns what it returns.  When Python has a signal to
// handle and its handler raises, as that of Ctrl-C does, `stop` becomes true, the work is waited
// for, and what was raised is thrown.  The work must touch nothing of Python.
template <class Work>
auto interruptible(const Work& work) {
  namespace py = pybind11;
  constexpr std::chrono::milliseconds kBetweenLooks{50};
  std::atomic<bool> stop{false};
  auto done = std::async(std::launch::async, [&] { return work(std::as_const(stop)); });
  std::optional<py::error_already_set> raised;
  for (;;) {
    {
      const py::gil_scoped_release unlocked;
      if (done.wait_for(kBetweenLooks) == std::future_status::ready) break;
    }
    if (raised || PyErr_CheckSignals() == 0) continue;
    raised.emplace();
    stop = true;
  }
  // What the stopped work throws says only that it was stopped.
  if (raised) throw py::error_already_set(*raised);
  return done.get();
}

}  // namespace domefall
