#include "pipeline/image/input_image.h"

#include <cmath>
#include <stdexcept>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kLargestSide = 32768;

}  // namespace

InputImage::InputImage(const std::filesystem::path& file) : file_(file) {
  const ImageFormats& formats = image_formats();
  try {
    reader_ = formats.open(file);
  } catch (const std::runtime_error& error) {
    fail(std::string("the image cannot be read: ") + error.what());
  }
  const ImageLayout& l = layout();
  if (l.width < 1 || l.height < 1 || l.width > kLargestSide || l.height > kLargestSide ||
      l.depth != 1)
    fail("the image must be 1 to 32768 pixels a side, got " + std::to_string(l.width) + " x " +
         std::to_string(l.height));
}

void InputImage::read(int first, int end, float* rgb) const {
  try {
    reader_->read(first, end, rgb);
  } catch (const std::runtime_error& error) {
    fail(std::string("the image cannot be read to its end: ") + error.what());
  }
}

void InputImage::fail(const std::string& what) const {
  throw InputError(file_.string() + ": " + what);
}

void InputImage::fail_not_finite(int x, int y) const {
  fail("pixel (" + std::to_string(x + 1) + ", " + std::to_string(y + 1) +
       ") is not a finite number");
}

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace domefall
