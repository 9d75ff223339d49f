#include "pipeline/image/read_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kLargestSide = 32768;

// IEC 61966-2-1.
float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw InputError(file.string() + ": " + what);
}

void check_finite(const FloatImage& image, const std::filesystem::path& file) {
  for (std::size_t k = 0; k < image.pixels.size(); ++k) {
    if (std::isfinite(image.pixels[k])) continue;
    const auto pixel = k / 3, width = static_cast<std::size_t>(image.width);
    fail(file, "pixel (" + std::to_string(pixel % width + 1) + ", " +
                   std::to_string(pixel / width + 1) + ") is not a finite number");
  }
}

}  // namespace

FloatImage read_image(const std::filesystem::path& file) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) fail(file, "the image cannot be read: " + OIIO::geterror());
  const OIIO::ImageSpec spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide ||
      spec.height > kLargestSide || spec.depth != 1)
    fail(file, "the image must be 1 to 32768 pixels a side, got " + std::to_string(spec.width) +
                   " x " + std::to_string(spec.height));
  const int used = std::min(spec.nchannels, 3) == 3 ? 3 : 1;
  FloatImage image(spec.width, spec.height);
  // Grey goes into the first of three channels and is spread from there.
  if (!in->read_image(0, 0, 0, used, OIIO::TypeDesc::FLOAT, image.pixels.data(), 3 * sizeof(float)))
    fail(file, "the image cannot be read to its end: " + in->geterror());
  if (used == 1)
    for (std::size_t k = 0; k < image.pixels.size(); k += 3)
      image.pixels[k + 1] = image.pixels[k + 2] = image.pixels[k];
  if (!spec.format.is_floating_point())
    std::transform(image.pixels.begin(), image.pixels.end(), image.pixels.begin(),
                   linear_from_srgb);
  check_finite(image, file);
  return image;
}

}  // namespace domefall
