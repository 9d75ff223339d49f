#include "pipeline/image/encode/exr_zip.h"

#include <cstdint>

namespace domefall {
namespace {

// Calls use(bits, place) for all numbers of the block in the order of the file: rows, in each its
// channels B, G and R.
template <class Use>
void each_number(const Imath::half* rgb, int width, int height, Use use) {
  std::size_t place = 0;
  for (int y = 0; y < height; ++y, rgb += static_cast<std::ptrdiff_t>(3) * width)
    for (int channel = 2; channel >= 0; --channel)
      for (int x = 0; x < width; ++x) use(rgb[3 * x + channel].bits(), place++);
}

// All low bytes and then all high ones, each less the one before it, plus 128.
void take_differences(const Imath::half* rgb, int width, int height, unsigned char* out) {
  unsigned char* const low = out;
  unsigned char* const high =
      out + static_cast<std::ptrdiff_t>(3) * width * static_cast<std::ptrdiff_t>(height);
  constexpr unsigned kMiddle = 128;
  unsigned before = 0;
  each_number(rgb, width, height, [&](unsigned bits, std::size_t place) {
    const unsigned down = (bits & 0xffU) - (before & 0xffU), up = (bits >> 8) - (before >> 8);
    low[place] = static_cast<unsigned char>(down + kMiddle);
    high[place] = static_cast<unsigned char>(up + kMiddle);
    before = bits;
  });
  // The first byte of each half has another one before it: none, and the last low byte.
  low[0] = static_cast<unsigned char>(low[0] - kMiddle);
  high[0] = static_cast<unsigned char>(high[0] - (before & 0xffU));
}

void put_in_order(const Imath::half* rgb, int width, int height, unsigned char* out) {
  each_number(rgb, width, height, [&](unsigned bits, std::size_t place) {
    out[2 * place] = static_cast<unsigned char>(bits);
    out[2 * place + 1] = static_cast<unsigned char>(bits >> 8);
  });
}

}  // namespace

std::string_view ExrZip::pack(const Imath::half* rgb, int width, int height) {
  const std::size_t size =
      sizeof(Imath::half) * 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  bytes_.reserve(size);
  bytes_.set_size(size);
  take_differences(rgb, width, height, bytes_.data());
  deflater_.pack_stream(bytes_.view(), packed_);
  if (packed_.size() < size) return packed_.view();
  put_in_order(rgb, width, height, bytes_.data());
  return bytes_.view();
}

}  // namespace domefall
