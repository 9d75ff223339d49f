#include "pipeline/image/light_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "pipeline/image/errors.h"
#include "pipeline/image/some_light.h"

namespace domefall {
namespace {

constexpr int kLargestSide = 32768, kBand = 64;
constexpr int kLargestExponent = 14;  // of a half, with one to spare

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw InputError(file.string() + ": " + what);
}

class Bands {
 public:
  explicit Bands(const std::filesystem::path& file)
      : file_(file), in_(OIIO::ImageInput::open(file.string())) {
    if (!in_) fail(file, "the image cannot be read: " + OIIO::geterror());
    const OIIO::ImageSpec& s = spec();
    if (s.width < 1 || s.height < 1 || s.width > kLargestSide || s.height > kLargestSide ||
        s.depth != 1)
      fail(file, "the image must be 1 to 32768 pixels a side, got " + std::to_string(s.width) +
                     " x " + std::to_string(s.height));
  }

  const OIIO::ImageSpec& spec() const { return in_->spec(); }

  // Calls `use(row, rgb)` for every row from the top; rgb is scratch that it may change.
  void each_row(const std::function<void(int, float*)>& use) const {
    const OIIO::ImageSpec& s = spec();
    const int band = s.tile_height > 0 ? s.tile_height : kBand, used = s.nchannels >= 3 ? 3 : 1;
    const auto row_floats = 3 * static_cast<std::size_t>(s.width);
    std::vector<float> rgb(static_cast<std::size_t>(band) * row_floats);
    for (int first = 0; first < s.height; first += band) {
      const int end = std::min(first + band, s.height);
      const OIIO::stride_t pixel = 3 * sizeof(float);
      const bool read =
          s.tile_height > 0
              ? in_->read_tiles(0, 0, s.x, s.x + s.width, s.y + first, s.y + end, s.z, s.z + 1, 0,
                                used, OIIO::TypeDesc::FLOAT, rgb.data(), pixel, pixel * s.width)
              : in_->read_scanlines(0, 0, s.y + first, s.y + end, s.z, 0, used,
                                    OIIO::TypeDesc::FLOAT, rgb.data(), pixel, pixel * s.width);
      if (!read) fail(file_, "the image cannot be read to its end: " + in_->geterror());
      for (int y = first; y < end; ++y) {
        float* row = rgb.data() + static_cast<std::size_t>(y - first) * row_floats;
        if (used == 1)
          for (std::size_t k = 0; k < row_floats; k += 3) row[k + 1] = row[k + 2] = row[k];
        use(y, row);
      }
    }
  }

 private:
  std::filesystem::path file_;
  std::unique_ptr<OIIO::ImageInput> in_;
};

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

// Integers and halves fit in halves as they are; of floats the greatest has to be known.
double unit_for(const std::filesystem::path& file, const Bands& bands) {
  if (bands.spec().format != OIIO::TypeDesc::FLOAT && bands.spec().format != OIIO::TypeDesc::DOUBLE)
    return 1;
  float greatest = 0;
  const int floats = 3 * bands.spec().width;
  bands.each_row([&](int y, const float* rgb) {
    for (int k = 0; k < floats; ++k) {
      if (!std::isfinite(rgb[k]))
        fail(file, "pixel (" + std::to_string(k / 3 + 1) + ", " + std::to_string(y + 1) +
                       ") is not a finite number");
      greatest = std::max(greatest, rgb[k]);
    }
  });
  return greatest > 0 ? std::ldexp(1.0, std::ilogb(greatest) - kLargestExponent) : 1;
}

}  // namespace

LightImage read_light_image(const std::filesystem::path& file, PixelEncoding encoding) {
  const Bands bands(file);
  const bool srgb = encoding == PixelEncoding::kSrgb || (encoding == PixelEncoding::kOfFile &&
                                                         !bands.spec().format.is_floating_point());
  LightImage image{{bands.spec().width, bands.spec().height}, srgb ? 1 : unit_for(file, bands)};
  const auto scale = static_cast<float>(1 / image.unit);
  const int floats = 3 * image.pixels.width;
  float least = 0, most = 0;  // of the file's values
  // A second reading, since keeping the floats would take twice the memory of the result.
  bands.each_row([&](int y, const float* rgb) {
    Imath::half* out = image.pixels.row(y);
    for (int k = 0; k < floats; ++k) {
      const float light = srgb ? linear_from_srgb(rgb[k]) : rgb[k] * scale;
      least = std::min(least, rgb[k]), most = std::max(most, rgb[k]);
      out[k] = std::max(light, 0.0f);
      if (!std::isfinite(light) || !out[k].isFinite())
        fail(file, "pixel (" + std::to_string(k / 3 + 1) + ", " + std::to_string(y + 1) +
                       ") is not a finite number");
    }
  });
  check_light(file, least, most);
  return image;
}

}  // namespace domefall
