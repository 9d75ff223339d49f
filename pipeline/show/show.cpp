#include "pipeline/show/show.h"

#include <algorithm>
#include <cmath>

namespace domefall {

int frame_count(const Show& show) {
  double seconds = 0;
  for (const Segment& segment : show.timeline) seconds += segment.duration_s;
  return std::max(1, static_cast<int>(std::lround(seconds * show.frames_per_second)));
}

}  // namespace domefall
