#include "pipeline/show/frame_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "pipeline/image/errors.h"
#include "projections/image_size.h"

namespace domefall {
namespace {

// These are the bounds of the key `size` (projection_section.cpp).
constexpr int kSmallest = 16, kLargest = 16384;  // pixels

// Returns the number that a text is, or -1 if it is no whole number.
int whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : -1;
}

bool is_frame_size(int pixels) { return pixels >= kSmallest && pixels <= kLargest; }

// Returns the projection with the sides of a text WIDTHxHEIGHT.  A text without an 'x' leaves an
// empty height, which is no number.
Projection with_stated_sides(const Projection& projection, const std::string& size,
                             const std::string& asked) {
  const std::size_t cross = std::min(size.find('x'), size.size());
  const int width = whole_number(std::string_view(size).substr(0, cross));
  const int height = whole_number(std::string_view(size).substr(std::min(cross + 1, size.size())));
  if (!is_frame_size(width) || !is_frame_size(height))
    throw InputError(asked + size +
                     ": a flat picture takes WIDTHxHEIGHT, each from 16 to 16384 pixels");
  if (std::holds_alternative<Fisheye>(projection) && height > width)
    throw InputError(asked + size + ": a fisheye is at most as high as wide");
  return with_sides(projection, width, height);
}

}  // namespace

Projection resized(const Projection& projection, const std::string& size, const std::string& name) {
  if (size.empty()) return projection;
  const std::string asked = name + " ";
  const bool fisheye = std::holds_alternative<Fisheye>(projection);
  // A fisheye alone takes both forms, since a single number makes it a square.
  if (has_free_shape(projection) && (!fisheye || size.find('x') != std::string::npos))
    return with_stated_sides(projection, size, asked);
  const bool sphere = std::holds_alternative<Equirectangular>(projection);
  const bool cube = std::holds_alternative<Cubemap>(projection);
  int pixels = whole_number(size);
  // The sizes of domes are named by their thousands, which are powers of two.
  if (size.ends_with('k')) {
    const int thousands = whole_number(std::string_view(size).substr(0, size.size() - 1));
    if (thousands == 1 || thousands == 2 || thousands == 4 || thousands == 8)
      pixels = thousands * 1024;
  }
  // The faces of a cubemap lie three abreast, which bounds their edge to a third of the width.
  if (cube) {
    if (!is_frame_size(pixels) || 3 * pixels > kLargest)
      throw InputError(
          fmt::format("{}{}: the faces of a cubemap take 1k, 2k, 4k or a number "
                      "of pixels from {} to {}",
                      asked, size, kSmallest, kLargest / 3));
    return Cubemap{pixels};
  }
  // A whole sphere is half as high as wide, so its width is even.
  if (!is_frame_size(pixels) || (sphere && pixels % 2 != 0))
    throw InputError(fmt::format("{}{}: {} takes 1k, 2k, 4k, 8k or {} from {} to {}", asked, size,
                                 sphere ? "the width of a whole sphere" : "a dome",
                                 sphere ? "an even number of pixels" : "a number of pixels",
                                 kSmallest, kLargest));
  return with_width(projection, pixels);
}

}  // namespace domefall
