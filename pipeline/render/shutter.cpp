#include "pipeline/render/shutter.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/base/simd/half_row.h"
#include "pipeline/render/scene/frame_plan.h"
#include "projections/projection.h"

namespace domefall {
namespace {

// Motion is measured at kPlaces places along each side of the image, and the part kExceeding of
// them may move farther than the result.
constexpr int kPlaces = 24;
constexpr double kExceeding = 0.05;
// A footprint counts as no narrower than this part of its length.  On an Einstein ring the width is
// 0, and any motion would be infinitely many pixels.
constexpr double kNarrowest = 0.25;

double motion_between(const Show& show, const FrameState& from, const FrameState& to,
                      LensStore& lenses) {
  const auto tracer = [&](const FrameState& state) {
    const WantedSkies wanted = plan_frame(show, state).wanted();
    return ViewTracer(state, lens_of(state.observer, wanted, show.effects, lenses), show.effects);
  };
  // In this order, in which the store has the tables of `to` for the next pair.
  const ViewTracer first = tracer(from), second = tracer(to);
  return motion_in_pixels(from, first, to, second);
}

}  // namespace

double motion_in_pixels(const FrameState& from, const ViewTracer& tracer_from, const FrameState& to,
                        const ViewTracer& tracer_to) {
  std::vector<double> motions;
  // Pixels are counted from 1, so that an image reaches from 0.5 to its width + 0.5.
  const double width = columns(from.projection), height = rows(from.projection);
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const PixelPosition pixel{(i + 0.5) * width / kPlaces + 0.5,
                                (j + 0.5) * height / kPlaces + 0.5};
      if (!is_inside(from.projection, pixel)) continue;
      const ViewRay a = tracer_from.trace(direction_at(from.projection, pixel));
      const ViewRay b = tracer_to.trace(direction_at(to.projection, pixel));
      if (!a.known || !b.known || a.sky != b.sky) continue;
      // A pixel that is stretched has two sides, whose product is its solid angle.
      const double side = pixel_angle(from.projection, pixel);
      const double other = pixel_solid_angle(from.projection, pixel) / side;
      // The motion on the sky is divided by the least width of a pixel's footprint there.
      motions.push_back((a.sky_direction - b.sky_direction).length() /
                        (std::min(side, other) * std::max(a.shorter(), kNarrowest * a.longer())));
    }
  if (motions.empty()) return 0;
  // nth_element() puts at this place the motion that the part kExceeding of all others exceed.
  const auto exceeded =
      motions.end() - 1 -
      static_cast<std::ptrdiff_t>(kExceeding * static_cast<double>(motions.size()));
  std::nth_element(motions.begin(), exceeded, motions.end());
  return *exceeded;
}

// A fraction of the distance takes an instant more, so that no step exceeds kPixelsPerInstant
// unless kMostInstants bounds their number.
int instants_for_motion(double motion_in_pixels) {
  return static_cast<int>(
      std::clamp(std::ceil(motion_in_pixels / kPixelsPerInstant), 1.0, double{kMostInstants}));
}

// The motion is summed over the middles of the four quarters of the exposure, between which lie
// three quarters of the whole motion.
int instants_for(const Show& show, const FrameState& state, LensStore& lenses) {
  constexpr int kParts = 4;
  const std::vector<FrameState> states = exposure_states(show, state, kParts);
  double motion = 0, vanishing_motion = 0;
  for (std::size_t k = 1; k < states.size(); ++k) {
    motion += motion_between(show, states[k - 1], states[k], lenses);
    if (states[k - 1].vanishing && states[k].vanishing)
      vanishing_motion +=
          motion_between(show, *states[k - 1].vanishing, *states[k].vanishing, lenses);
  }
  return instants_for_motion(std::max(motion, vanishing_motion) * kParts / (kParts - 1));
}

namespace {

// Calls use(first, end) for pieces of a plane, by all threads.
template <class Use>
void each_piece(std::size_t size, const Use& use) {
  constexpr std::size_t kPiece = 1 << 15;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, kPiece),
                    [&](const auto& range) { use(range.begin(), range.end()); });
}

void store_mean(const float* sum, float share, std::size_t count, float* to) {
  std::transform(sum, sum + count, to, [share](float value) { return value * share; });
}
void store_mean(const float* sum, float share, std::size_t count, Imath::half* to) {
  std::vector<float> mean(count);
  store_mean(sum, share, count, mean.data());
  to_half(mean.data(), static_cast<int>(count), reinterpret_cast<std::uint16_t*>(to));
}

}  // namespace

template <class T>
void MeanFrame::add(LayeredFrame<T>& instant) {
  std::size_t plane = 0;
  const auto add_plane = [&](const auto& values) {
    if (count_ == 0) sums_.emplace_back();
    std::vector<float>& sum = sums_[plane++];
    // A layer may be empty in this instant and not in another.
    sum.resize(std::max(sum.size(), values.size()));
    each_piece(values.size(), [&](std::size_t first, std::size_t end) {
      for (std::size_t k = first; k < end; ++k) sum[k] += values[k];
    });
  };
  for (const auto* values : instant.lights()) add_plane(*values);
  for (const auto* values : instant.alphas()) add_plane(*values);
  ++count_;
}

template <class T>
void MeanFrame::store(LayeredFrame<T>& frame) const {
  const float share = 1 / static_cast<float>(count_);
  std::size_t plane = 0;
  const auto store_plane = [&](auto& values) {
    const std::vector<float>& sum = sums_[plane++];
    values.resize(sum.size());
    each_piece(sum.size(), [&](std::size_t first, std::size_t end) {
      store_mean(sum.data() + first, share, end - first, values.data() + first);
    });
  };
  for (auto* values : frame.lights()) store_plane(*values);
  for (auto* values : frame.alphas()) store_plane(*values);
}

template void MeanFrame::add(LayeredHalfFrame&);
template void MeanFrame::add(LayeredFloatFrame&);
template void MeanFrame::store(LayeredHalfFrame&) const;
template void MeanFrame::store(LayeredFloatFrame&) const;

}  // namespace domefall
