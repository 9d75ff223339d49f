#include "pipeline/show/show.h"

#include <algorithm>
#include <cmath>

namespace domefall {

double value_at(const Segment& segment, Channel channel, double t, double constant) {
  const std::optional<Curve>& curve = segment.curves[channel];
  return curve ? value_at(*curve, t) : constant;
}

std::vector<double> segment_times(const Show& show) {
  std::vector<double> times;
  times.reserve(show.timeline.size() + 1);
  double end = 0;
  for (const Segment& segment : show.timeline) {
    times.push_back(end - segment.dissolve_s);
    end = times.back() + segment.duration_s;
  }
  times.push_back(end);
  return times;
}

int frame_count(const Show& show) {
  const double seconds = show.joints.empty()
                             ? segment_times(show).back()
                             : show.joints.back().begin_s + show.timeline.back().duration_s;
  return std::max(1, static_cast<int>(std::lround(seconds * show.frames_per_second)));
}

}  // namespace domefall
