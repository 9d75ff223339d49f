// A GradeTable is a view as a table, which is several times as quick as following its formulas for
// each pixel.
//
// A pixel is split into its largest channel M, the ratio of its least channel to M, which is how
// grey it is, and the place of the third between the two, which is a hue.  There is such a split
// for each of the six orders of the channels, so that what a view does at M, at the least channel
// or at the grey axis is no kink within a cell.  M has 32 nodes to the octave, evenly spaced within
// each, down to 2^-14 and 32 evenly spaced ones below.  The ratio has 21, even in its square root,
// from 0.25 to 1, and the hue 9.  Codes are interpolated by parabolas in ratio and hue and linearly
// in M.
//
// When the table is made, each of its cells is compared with the formulas at two to five places.
// One that errs by more than 0.8 kMostError there is left out with its neighbours.  So are cells in
// which a channel leaves black, ratios below 0.25, values that are negative or above 65504, and
// what is no number.  The caller grades those pixels by the formulas.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include "pipeline/grade/pixel_planes.h"

namespace domefall {

// SharedSteps are work that is shared by the threads which need its result, without a thread of its
// own.
class SharedSteps {
 public:
  explicit SharedSteps(int count) : count_(count) {}

  // Calls step(number) for numbers from 0 to count - 1 that no other caller has taken, until none
  // is left, and returns once all are done.  All callers give the same steps.  What a step throws,
  // each of them throws.
  template <class Step>
  void take(const Step& step) {
    for (int k = next_++; k < count_; k = next_++) {
      try {
        step(k);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        error_ = std::current_exception();
      }
      if (++done_ == count_) done_.notify_all();
    }
    for (int done = done_; done < count_; done = done_) done_.wait(done);
    const std::lock_guard lock(mutex_);
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const int count_;
  std::atomic<int> next_ = 0, done_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
};

class GradeTable {
 public:
  // This is half a step of a 12-bit display, as a part of white.
  static constexpr double kMostError = 0.5 / 4095;

  // Grades pixels of three floats to codes from 0 to 1.  Several threads call it at once.
  using Formulas = std::function<void(const float* rgb, int pixels, float* codes)>;

  explicit GradeTable(Formulas formulas);

  // Makes the table, which takes up to 0.7 s of processor time and keeps 18 MB, unless it is made.
  // Threads that call this at the same time share the work, so that no more of them are busy than
  // grade.
  void make();

  // Grades `count` pixels to 16 bits by a table that is made, and writes the numbers of those that
  // it does not hold, in ascending order, to missed[].  Returns how many those are.  Their codes
  // are not set.  out[] and missed[] have room for one value more, which is overwritten.
  int look_up(const PixelPlanes& planes, int count, unsigned short* out, int* missed) const;

  // These return the largest error found in the cells that are held, as a part of white, and the
  // part of all cells that is held.
  double error() const { return error_; }
  double held() const { return held_; }

 private:
  void fill(int block);
  void compare(int block);
  void hold();

  Formulas formulas_;
  std::vector<float> nodes_;   // table_lookup.h
  std::vector<float> errors_;  // of each cell, until it is decided which are held
  SharedSteps allocating_{1}, filling_, comparing_, holding_;
  std::atomic<bool> made_ = false;
  double error_ = 0, held_ = 0;
};

}  // namespace domefall
