#include "pipeline/image/input_image.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <system_error>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

// Calls step(), and puts the file's name before the reasons of the library, which lack it.
template <class Step>
auto named(const std::filesystem::path& file, const char* what, Step step) {
  try {
    return step();
  } catch (const InputError&) {
    throw;
  } catch (const TemporaryError&) {
    throw;
  } catch (const std::system_error& error) {  // of threads that it may not start
    throw TemporaryError(file.string() + ": " + what + ": " + error.what());
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + what + ": " + error.what());
  }
}

}  // namespace

InputImage::InputImage(const std::filesystem::path& file) : file_(file) {
  const ImageFormats& formats = image_formats();
  reader_ = named(file, "the image cannot be read", [&] { return formats.open(file); });
}

void InputImage::read(int first, int end, float* rgb) const {
  named(file_, "the image cannot be read to its end", [&] { reader_->read(first, end, rgb); });
}

void InputImage::read(unsigned short* rgb) const {
  named(file_, "the image cannot be read to its end", [&] { reader_->read(rgb); });
}

void InputImage::fail_not_finite(int x, int y) const {
  throw InputError(
      fmt::format("{}: pixel ({}, {}) is not a finite number", file_.string(), x + 1, y + 1));
}

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace domefall
