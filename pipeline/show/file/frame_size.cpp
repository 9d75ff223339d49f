#include "pipeline/show/file/frame_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "pipeline/base/errors.h"
#include "projections/projection.h"

namespace domefall {
namespace {

constexpr int kSmallest = 16, kLargest = 16384;  // pixels

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
  if (traits_of(projection).is_dome && height > most_rows(width, pixel_aspect(projection)))
    throw InputError(asked + size + ": a fisheye is at most as high as wide");
  return with_sides(projection, width, height);
}

}  // namespace

Projection resized(const Projection& projection, const std::string& size, const std::string& name) {
  if (size.empty()) return projection;
  const std::string asked = name + " ";
  const ProjectionTraits& traits = traits_of(projection);
  // A fisheye alone takes both forms, since a single number makes it a square.
  if (traits.one_number.empty() ||
      (has_free_shape(projection) && size.find('x') != std::string::npos))
    return with_stated_sides(projection, size, asked);
  int pixels = whole_number(size);
  if (size.ends_with('k')) {
    const int thousands = whole_number(std::string_view(size).substr(0, size.size() - 1));
    if (thousands == 1 || thousands == 2 || thousands == 4 || thousands == 8)
      pixels = thousands * 1024;
  }
  // A fisheye is higher than wide where its pixels are wider than high.
  const double high = std::max(1.0, static_cast<double>(rows(projection)) / columns(projection));
  const int most = static_cast<int>(kLargest / high) / traits.in_width;
  if (pixels < kSmallest || pixels > most || (traits.even && pixels % 2 != 0)) {
    constexpr int kEight = 8192;
    const bool faces = traits.in_width > 1;
    throw InputError(fmt::format("{}{}: {} {} 1k, 2k, 4k{} or {} number of pixels from {} to {}",
                                 asked, size, traits.taker, faces ? "take" : "takes",
                                 most < kEight ? "" : ", 8k", traits.even ? "an even" : "a",
                                 kSmallest, most));
  }
  return with_width(projection, traits.in_width * pixels);
}

}  // namespace domefall
