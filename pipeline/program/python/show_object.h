// A ShowObject is a show as an object of Python.
#pragma once

#include <pybind11/numpy.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>

#include "pipeline/grade/grader.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/show.h"

namespace domefall {

// Any number of Python's threads may use one object.  Their frames are rendered one after the
// other, each by all `threads` (0: one for each processor).
class ShowObject {
 public:
  // Throws as read_show, and InputError unless 0 <= threads <= 1024 and `file` is a path.
  ShowObject(const pybind11::object& file, const pybind11::object& threads);

  const Show& show() const { return show_; }

  // Returns the states of frames as records with the columns of state_columns.h.  `frames` is None
  // for all frames, or else an integer or an array of integers, whose shape the result has.
  pybind11::array states(const pybind11::object& frames) const;

  // Returns a frame in linear light as float32 [row][column][RGB], in ACEScg.  Its numbers are
  // those of the files of `linear: float`.  `size` is None, an integer, a pair or a text as --size
  // takes it.
  pybind11::array frame(const pybind11::object& number, const pybind11::object& size);

  // Returns a graded frame as uint16 [row][column][RGB], with the codes of the files of 16 bits.
  pybind11::array graded(const pybind11::object& number, const pybind11::object& size);

 private:
  FrameState state_of(const pybind11::object& number, const pybind11::object& size) const;
  void with_renderer(const std::atomic<bool>& stop, const std::function<void(Renderer&)>& use);

  int threads_;
  Show show_;
  std::timed_mutex turn_;  // of what follows
  std::optional<Renderer> renderer_;
  std::optional<Grader> grader_;
  std::optional<FrameGrading> grading_;
};

}  // namespace domefall
