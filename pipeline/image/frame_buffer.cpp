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

// Both functions compare signed numbers, since SSE2 has no maximum of unsigned words.

unsigned short greatest_value(const unsigned short* values, std::size_t count) {
  constexpr int kHighest = 0x8000;
  auto most = static_cast<short>(kHighest);
  for (std::size_t k = 0; k < count; ++k)
    most = std::max(most, static_cast<short>(values[k] ^ kHighest));
  return static_cast<unsigned short>(most ^ kHighest);
}

unsigned short greatest_magnitude(const unsigned short* halves, std::size_t count) {
  short most = 0;
  for (std::size_t k = 0; k < count; ++k)
    most = std::max(most, static_cast<short>(halves[k] & 0x7fff));
  return static_cast<unsigned short>(most);
}

}  // namespace domefall
