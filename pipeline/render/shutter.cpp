#include "pipeline/render/shutter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/render/scene/body_sight.h"
#include "pipeline/simd/half_row.h"
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

// Returns how far, in pixels, the direct image of any body moves that is bright enough to be seen.
double motion_of_bodies(const Show& show, const FrameState& from, const FrameState& to) {
  constexpr double kFaintest = 10;  // V at 0 EV, fainter than the stars of a default sky
  const double magnitudes_per_stop = 2.5 * std::log10(2.0);  // a stop doubles the light
  const BodySight before(from, show.effects, show.least_star_radius),
      after(to, show.effects, show.least_star_radius);
  if (!before.sees() || !after.sees()) return 0;
  double most = 0;
  for (const Body& body : show.bodies) {
    const auto first = before.image(body, 0), last = after.image(body, 0);
    if (!first || !last) continue;
    const BodySight::Seen at = before.seen(first->at);
    const auto begin = pixel_of(from.projection, at.direction),
               end = pixel_of(to.projection, after.seen(last->at).direction);
    // A factor in flux is 2.5 log10 of it in magnitudes.
    const double magnitude = body.magnitude - 2.5 * std::log10(at.brightening);
    if (begin && end && magnitude < kFaintest + magnitudes_per_stop * from.settings.ev)
      most = std::max(most, std::hypot(end->i - begin->i, end->j - begin->j));
  }
  return most;
}

// Returns the motion in pixels between two instants, of the sky or of a body, whichever is larger.
double motion_between(const Show& show, const FrameState& from, const FrameState& to,
                      OpticsStore& optics) {
  // The store keeps the optics of one radius only, so those of the first state are copied.
  const HoleOptics first = optics.optics_for(from.observer, plan_frame(show, from));
  const HoleOptics& second = optics.optics_for(to.observer, plan_frame(show, to));
  return std::max(motion_in_pixels(from, ViewTracer(from, first, show.effects), to,
                                   ViewTracer(to, second, show.effects)),
                  motion_of_bodies(show, from, to));
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
      const double longer = std::max(a.radial_scale, a.tangential_scale);
      const double shorter = std::min(a.radial_scale, a.tangential_scale);
      // A pixel that is stretched has two sides, whose product is its solid angle.
      const double side = pixel_angle(from.projection, pixel);
      const double other = pixel_solid_angle(from.projection, pixel) / side;
      // The motion on the sky is divided by the least width of a pixel's footprint there.
      motions.push_back((a.sky_direction - b.sky_direction).length() /
                        (std::min(side, other) * std::max(shorter, kNarrowest * longer)));
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
int instants_for(const Show& show, const FrameState& state, OpticsStore& optics) {
  constexpr int kParts = 4;
  std::vector<FrameState> states = exposure_states(show, state.frame, kParts);
  for (FrameState& exposed : states) take_size(state, exposed);
  double motion = 0, vanishing_motion = 0;
  for (std::size_t k = 1; k < states.size(); ++k) {
    motion += motion_between(show, states[k - 1], states[k], optics);
    if (states[k - 1].vanishing && states[k].vanishing)
      vanishing_motion +=
          motion_between(show, *states[k - 1].vanishing, *states[k].vanishing, optics);
  }
  return instants_for_motion(std::max(motion, vanishing_motion) * kParts / (kParts - 1));
}

template <class T>
void MeanFrame::add(const ImageRgb<T>& instant) {
  // The first instant says how large the sum is.
  if (count_++ == 0) sum_ = FloatImage(instant.width, instant.height);
  tbb::parallel_for(0, instant.height, [&](int row) {
    const T* from = instant.row(row);
    float* to = sum_.row(row);
    for (int k = 0; k < 3 * instant.width; ++k) to[k] += from[k];
  });
}

template void MeanFrame::add(const HalfFrame&);
template void MeanFrame::add(const FloatImage&);

void MeanFrame::store(FloatImage& frame) const {
  const float share = 1 / static_cast<float>(count_);
  tbb::parallel_for(0, frame.height, [&](int row) {
    std::transform(sum_.row(row), sum_.row(row) + static_cast<std::ptrdiff_t>(3) * frame.width,
                   frame.row(row), [share](float sum) { return sum * share; });
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
