// Shows of one held instant, for the extreme cases.
#pragma once

#include <string>

#include "pipeline/report/extreme_cases.h"
#include "pipeline/show/show.h"

namespace domefall {

inline constexpr int kExtremeSize = 96;  // pixels along an edge of a frame

// A show in which every sky is lit: the grid in all regions, and stars in I and III.  The hole is
// at the pole of the grid, where right ascension has no value, which is the worst place for it.
// Throws InputError if the shipped catalogue cannot be read.
Show extreme_show(const Trajectory& trajectory, const Projection& projection,
                  const Attitude& attitude);

// Renders frames and counts the pixel values that are not finite or are negative.
class FrameTally {
 public:
  // Renders frame 0.  A frame that the renderer refuses, since a pixel is not finite, counts as
  // one.
  void add(const Show& show);

  // worst: the count.  outcome: how many frames there were and their brightest value, before
  // `more`.
  ExtremeResult result(const std::string& more) const;

 private:
  int frames_ = 0, bad_ = 0;
  double brightest_ = 0;
};

}  // namespace domefall
