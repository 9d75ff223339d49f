#include "pipeline/image/greatest_value.h"

#include <algorithm>

namespace domefall {

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
