#include "pipeline/render/frames/brightest_value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/image_formats.h"

namespace domefall {

double brightest_value(const HalfFrame& frame) {
  static_assert(sizeof(Imath::half) == sizeof(unsigned short));
  const unsigned short most = greatest_magnitude(
      reinterpret_cast<const unsigned short*>(frame.pixels.data()), frame.pixels.size());
  const Imath::half brightest(Imath::half::FromBits, most);
  return brightest.isFinite() ? static_cast<double>(brightest)
                              : std::numeric_limits<double>::infinity();
}

RowPicture watched(const RowPicture& picture, std::atomic<unsigned short>& brightest) {
  const auto rows = [&picture, &brightest](int first, int end, unsigned short* rgb) {
    picture.rows(first, end, rgb);
    const std::size_t count =
        static_cast<std::size_t>(end - first) * static_cast<std::size_t>(picture.width) * 3;
    const unsigned short most = greatest_value(rgb, count);
    unsigned short known = brightest;
    while (known < most && !brightest.compare_exchange_weak(known, most)) {
    }
  };
  return {picture.width, picture.height, rows};
}

double brightest_in_file(const std::filesystem::path& path) {
  const auto reader = image_formats().open(path, PixelEncoding::kStored);
  const ImageLayout& layout = reader->layout();
  const int band = std::max(layout.band, 1);
  std::vector<float> rgb(static_cast<std::size_t>(band) * static_cast<std::size_t>(layout.width) *
                         3);
  // Codes are always numbers, so that a frame need not be decoded beyond the first that is light.
  const bool codes = path.extension() != ".exr";
  float most = 0;
  for (int first = 0; first < layout.height; first += band) {
    if (codes && most > kBrightestOfBlackCodes) break;
    const int end = std::min(first + band, layout.height);
    reader->read(first, end, rgb.data());
    const std::size_t count =
        static_cast<std::size_t>(end - first) * static_cast<std::size_t>(layout.width) * 3;
    for (std::size_t k = 0; k < count; ++k) {
      if (!std::isfinite(rgb[k])) return std::numeric_limits<double>::infinity();
      most = std::max(most, std::fabs(rgb[k]));
    }
  }
  return most;
}

}  // namespace domefall
