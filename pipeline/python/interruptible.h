// This file does long work for Python without Python's lock, so that other threads of Python go on
// and Ctrl-C ends the work.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

namespace domefall {

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
