#include "pipeline/image/encode/exr_zip.h"

#include <bit>
#include <cstdint>

namespace domefall {
namespace {

// Returns how many words of 16 bits a number has.  The lower word comes first.
constexpr std::size_t words_in(const Imath::half*) { return 1; }
constexpr std::size_t words_in(const float*) { return 2; }

template <class Use>
void each_word_of(Imath::half value, std::size_t place, Use use) {
  use(unsigned{value.bits()}, place);
}
template <class Use>
void each_word_of(float value, std::size_t place, Use use) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  use(bits & 0xffffU, 2 * place);
  use(bits >> 16, 2 * place + 1);
}

// Calls use(word, place) for all words of the block in the order of the file, which has rows, and
// in each its channels B, G and R.
template <class T, class Use>
void each_word(const T* rgb, int width, int height, Use use) {
  std::size_t place = 0;
  for (int y = 0; y < height; ++y, rgb += static_cast<std::ptrdiff_t>(3) * width)
    for (int channel = 2; channel >= 0; --channel)
      for (int x = 0; x < width; ++x) each_word_of(rgb[3 * x + channel], place++, use);
}

template <class T>
std::size_t words_of(const T* rgb, int width, int height) {
  return words_in(rgb) * 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// All low bytes come first and then all high ones, each less the one before it, plus 128.
template <class T>
void take_differences(const T* rgb, int width, int height, unsigned char* out) {
  unsigned char* const low = out;
  unsigned char* const high = out + words_of(rgb, width, height);
  constexpr unsigned kMiddle = 128;
  unsigned before = 0;
  each_word(rgb, width, height, [&](unsigned bits, std::size_t place) {
    const unsigned down = (bits & 0xffU) - (before & 0xffU), up = (bits >> 8) - (before >> 8);
    low[place] = static_cast<unsigned char>(down + kMiddle);
    high[place] = static_cast<unsigned char>(up + kMiddle);
    before = bits;
  });
  // Before the first low byte there is none, and before the first high byte there is the last low
  // byte.
  low[0] = static_cast<unsigned char>(low[0] - kMiddle);
  high[0] = static_cast<unsigned char>(high[0] - (before & 0xffU));
}

template <class T>
void put_in_order(const T* rgb, int width, int height, unsigned char* out) {
  each_word(rgb, width, height, [&](unsigned bits, std::size_t place) {
    out[2 * place] = static_cast<unsigned char>(bits);
    out[2 * place + 1] = static_cast<unsigned char>(bits >> 8);
  });
}

}  // namespace

template <class T>
std::string_view ExrZip::pack_words(const T* rgb, int width, int height) {
  const std::size_t size = 2 * words_of(rgb, width, height);
  bytes_.reserve(size);
  bytes_.set_size(size);
  take_differences(rgb, width, height, bytes_.data());
  deflater_.pack_stream(bytes_.view(), packed_);
  if (packed_.size() < size) return packed_.view();
  put_in_order(rgb, width, height, bytes_.data());
  return bytes_.view();
}

std::string_view ExrZip::pack(const Imath::half* rgb, int width, int height) {
  return pack_words(rgb, width, height);
}

std::string_view ExrZip::pack(const float* rgb, int width, int height) {
  return pack_words(rgb, width, height);
}

}  // namespace domefall
