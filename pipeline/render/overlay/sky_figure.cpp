#include "pipeline/render/overlay/sky_figure.h"

#include <algorithm>
#include <cmath>

#include "pipeline/render/overlay/frame_marks.h"
#include "pipeline/render/overlay/stroke.h"
#include "trajectories/degree.h"

namespace domefall {
namespace {

// Adds the line from one place to another.
void add_line(const SkyDirection& from, const SkyDirection& to, const DirectSky& sky,
              const Projection& projection, Coverage& coverage) {
  constexpr double kClear = 0.6 * kDegree;  // from a star to the end of a line
  constexpr int kSteps = 64;
  // An image that moves so many times as fast as its place has jumped.
  constexpr double kJump = 20;
  const double length = std::atan2(from.v.cross(to.v).length(), from.v.dot(to.v));
  const double clear = std::min(kClear, length / 4);
  if (!(length > 0)) return;
  const auto image = [&](double angle) {
    const V3d place = from.v * std::sin(length - angle) + to.v * std::sin(angle);
    return sky.image({place.normalized()}).v;
  };
  const double step = (length - 2 * clear) / kSteps;
  int first = 0;
  V3d before = image(clear);
  for (int k = 1; k <= kSteps; ++k) {
    const V3d now = image(clear + k * step);
    const bool jumps = (now - before).length() > kJump * step;
    const int last = jumps ? k - 1 : k;
    if ((jumps || k == kSteps) && last > first) {
      const double begin = clear + first * step, end = clear + last * step;
      add_curve([&](double part) { return image(std::lerp(begin, end, part)); }, false,
                mark_width(projection), projection, coverage);
    }
    if (jumps) first = k;
    before = now;
  }
}

}  // namespace

DirectSky::DirectSky(const FrameState& state, const Effects& effects)
    : sky_(own_sky(state.observer)), sight_(state, effects) {}

void add_figure(const SkyFigure& figure, const DirectSky& sky, const Projection& projection,
                Coverage& coverage) {
  for (const std::vector<SkyDirection>& line : figure)
    for (std::size_t k = 1; k < line.size(); ++k)
      add_line(line[k - 1], line[k], sky, projection, coverage);
}

}  // namespace domefall
