#include "pipeline/cli/frame_size.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kSmallest = 16, kLargest = 16384;

// The number that a text is; -1 if it is no whole number.
int whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : -1;
}

bool in_range(int pixels) { return pixels >= kSmallest && pixels <= kLargest; }

}  // namespace

Projection resized(const Projection& projection, const std::string& size) {
  if (size.empty()) return projection;
  if (const auto* flat = std::get_if<Stereographic>(&projection)) {
    const std::size_t cross = std::min(size.find('x'), size.size());
    const int width = whole_number(std::string_view(size).substr(0, cross));
    const int height =
        whole_number(std::string_view(size).substr(std::min(cross + 1, size.size())));
    if (!in_range(width) || !in_range(height))
      throw InputError("--size " + size +
                       ": a flat picture takes WIDTHxHEIGHT, each from 16 to 16384 pixels");
    return Stereographic{width, height, flat->fov};
  }
  int pixels = whole_number(size);
  if (size.ends_with('k')) {
    const int thousands = whole_number(std::string_view(size).substr(0, size.size() - 1));
    if (thousands == 1 || thousands == 2 || thousands == 4 || thousands == 8)
      pixels = thousands * 1024;
  }
  if (!in_range(pixels))
    throw InputError("--size " + size +
                     ": a dome takes 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384");
  return Domemaster{pixels};
}

}  // namespace domefall
