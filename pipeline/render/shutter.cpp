#include "pipeline/render/shutter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/simd/half_row.h"
#include "projections/projection.h"

namespace domefall {
namespace {

// Places along each side of the picture at which motion is looked at.
constexpr int kPlaces = 24;
constexpr double kExceeding = 0.05;
// Of the longer side of a footprint: an Einstein ring's shorter side is 0.
constexpr double kNarrowest = 0.25;

}  // namespace

double motion_in_pixels(const FrameState& from, const ViewTracer& tracer_from, const FrameState& to,
                        const ViewTracer& tracer_to) {
  std::vector<double> motions;
  const double width = columns(from.projection), height = rows(from.projection);
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const PixelPosition pixel{(i + 0.5) * width / kPlaces + 0.5,
                                (j + 0.5) * height / kPlaces + 0.5};
      if (!is_inside(from.projection, pixel)) continue;
      const ViewRay a = tracer_from.trace(direction_at(from.projection, pixel));
      const ViewRay b = tracer_to.trace(direction_at(to.projection, pixel));
      if (!a.known || !b.known || a.sky != b.sky) continue;
      const double longer = std::max(a.radial_scale, a.tangential_scale);
      const double shorter = std::min(a.radial_scale, a.tangential_scale);
      const double side = pixel_angle(from.projection, pixel),
                   other = pixel_solid_angle(from.projection, pixel) / side;
      motions.push_back((a.sky_direction - b.sky_direction).length() /
                        (std::min(side, other) * std::max(shorter, kNarrowest * longer)));
    }
  if (motions.empty()) return 0;
  const auto exceeded =
      motions.end() - 1 -
      static_cast<std::ptrdiff_t>(kExceeding * static_cast<double>(motions.size()));
  std::nth_element(motions.begin(), exceeded, motions.end());
  return *exceeded;
}

int instants_for_motion(double motion_in_pixels) {
  return static_cast<int>(
      std::clamp(std::ceil(motion_in_pixels / kPixelsPerInstant), 1.0, double{kMostInstants}));
}

void MeanFrame::add(const HalfFrame& picture) {
  if (count_++ == 0) sum_ = FloatImage(picture.width, picture.height);
  tbb::parallel_for(0, picture.height, [&](int row) {
    const Imath::half* from = picture.row(row);
    float* to = sum_.row(row);
    for (int k = 0; k < 3 * picture.width; ++k) to[k] += from[k];
  });
}

void MeanFrame::store(HalfFrame& frame) const {
  const float share = 1 / static_cast<float>(count_);
  tbb::parallel_for(0, frame.height, [&](int row) {
    std::vector<float> mean(static_cast<std::size_t>(frame.width) * 3);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = sum_.row(row)[k] * share;
    to_half(mean.data(), 3 * frame.width, reinterpret_cast<std::uint16_t*>(frame.row(row)));
  });
}

}  // namespace domefall
