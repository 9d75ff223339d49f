#include "pipeline/image/frame_buffer.h"

#include <algorithm>
#include <limits>

namespace domefall {

HalfFrame half_frame(const FloatImage& frame) {
  const auto largest = static_cast<float>(std::numeric_limits<Imath::half>::max());
  HalfFrame halves(frame.width, frame.height);
  std::transform(frame.pixels.begin(), frame.pixels.end(), halves.pixels.begin(),
                 [largest](float value) { return Imath::half(std::clamp(value, 0.0f, largest)); });
  return halves;
}

}  // namespace domefall
