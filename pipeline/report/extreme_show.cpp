#include "pipeline/report/extreme_show.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "pipeline/render/renderer.h"
#include "pipeline/show/assets.h"

namespace domefall {

Show extreme_show(const Trajectory& trajectory, const Projection& projection,
                  const Attitude& attitude) {
  Show show;
  show.projection = projection;
  show.hole_at = {V3d(0, 0, 1)};
  show.sky[SkyRegion::kI].background = GridSky{};
  show.sky[SkyRegion::kI].stars = StarField{shipped_asset(kStandardStars), 5};
  show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
  show.sky[SkyRegion::kIV].background = GridSky{};
  show.point_spread.min_sigma = 0.002;
  show.point_spread.max_sigma = 0.02;
  Segment segment;
  segment.duration_s = 1;
  segment.trajectory = trajectory;
  segment.camera.attitude = attitude;
  show.timeline = {segment};
  return show;
}

void FrameTally::add(const Show& show) {
  ++frames_;
  try {
    const HalfFrame frame = Renderer(show, 0).render(frame_state(show, 0));
    // The renderer refuses light that is not finite, which is counted below, and stores any other
    // light beyond the largest half, 65504, as that.  So a value here is bad only if the renderer
    // breaks one of these promises.
    for (const Imath::half value : frame.pixels) {
      if (!std::isfinite(static_cast<float>(value)) || value < 0) ++bad_;
      brightest_ = std::max(brightest_, static_cast<double>(value));
    }
  } catch (const std::runtime_error&) {
    ++bad_;
  }
}

ExtremeResult FrameTally::result(const std::string& more) const {
  return {static_cast<double>(bad_),
          fmt::format("{} frames, brightest pixel {:.3g}. {}", frames_, brightest_, more)};
}

}  // namespace domefall
