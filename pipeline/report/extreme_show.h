// The extreme cases are rendered from shows that hold one instant.
#pragma once

#include <string>

#include "pipeline/report/extreme_cases.h"
#include "pipeline/show/show.h"

namespace domefall {

inline constexpr int kExtremeSize = 96;  // pixels along an edge of a frame

// Returns a show in which every sky is lit: all regions have the grid, and I and III have stars.
// The hole stands at the pole of the grid, which is the worst place because right ascension has no
// value there.  Throws InputError if the shipped catalogue cannot be read.
Show extreme_show(const Trajectory& trajectory, const Projection& projection,
                  const Attitude& attitude);

// A FrameTally renders frames and counts the pixel values that are not finite or are negative.
class FrameTally {
 public:
  // Renders frame 0 of the show.  If the renderer throws, as it does for a pixel that is not
  // finite, the frame counts as one bad value.
  void add(const Show& show);

  // Returns the number of bad values as `worst`.  The text of the outcome gives the number of
  // frames, their brightest value, and then `more`.
  ExtremeResult result(const std::string& more) const;

 private:
  int frames_ = 0, bad_ = 0;
  double brightest_ = 0;
};

}  // namespace domefall
