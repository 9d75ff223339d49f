#include "pipeline/image/light_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/image/input_image.h"
#include "pipeline/image/some_light.h"

namespace domefall {
namespace {

constexpr int kLargestExponent = 14;  // of a half, with one to spare

// Calls `use(y, rgb)` for every row from the top.
template <class Use>
void each_row(const InputImage& in, Use use) {
  const ImageLayout& l = in.layout();
  const auto row_floats = 3 * static_cast<std::size_t>(l.width);
  std::vector<float> rgb(static_cast<std::size_t>(l.band) * row_floats);
  for (int first = 0; first < l.height; first += l.band) {
    const int end = std::min(first + l.band, l.height);
    in.read(first, end, rgb.data());
    for (int y = first; y < end; ++y)
      use(y, rgb.data() + static_cast<std::size_t>(y - first) * row_floats);
  }
}

// Integers and halves fit in halves as they are, but of floats the greatest has to be known.
double unit_for(const InputImage& in) {
  if (in.layout().samples != SampleType::kFloat) return 1;
  float greatest = 0;
  const int floats = 3 * in.layout().width;
  each_row(in, [&](int y, const float* rgb) {
    for (int k = 0; k < floats; ++k) {
      if (!std::isfinite(rgb[k])) in.fail_not_finite(k / 3, y);
      greatest = std::max(greatest, rgb[k]);
    }
  });
  return greatest > 0 ? std::ldexp(1.0, std::ilogb(greatest) - kLargestExponent) : 1;
}

}  // namespace

LightImage read_light_image(const std::filesystem::path& file, PixelEncoding encoding) {
  const InputImage in(file);
  const ImageLayout& layout = in.layout();
  const bool srgb = encoding == PixelEncoding::kSrgb ||
                    (encoding == PixelEncoding::kOfFile && !is_floating_point(layout.samples));
  LightImage image{{layout.width, layout.height}, srgb ? 1 : unit_for(in)};
  const auto scale = static_cast<float>(1 / image.unit);
  const int floats = 3 * image.pixels.width;
  float least = 0, most = 0;  // of the file's values
  // The file is read a second time, since keeping the floats would take twice the memory of the
  // result.
  each_row(in, [&](int y, const float* rgb) {
    Imath::half* out = image.pixels.row(y);
    for (int k = 0; k < floats; ++k) {
      const float light = srgb ? linear_from_srgb(rgb[k]) : rgb[k] * scale;
      least = std::min(least, rgb[k]), most = std::max(most, rgb[k]);
      out[k] = std::max(light, 0.0f);
      if (!std::isfinite(light) || !out[k].isFinite()) in.fail_not_finite(k / 3, y);
    }
  });
  check_light(file, least, most);
  return image;
}

}  // namespace domefall
