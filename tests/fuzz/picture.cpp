// Pictures, by their header and, where they are small, by their pixels.
#include "pipeline/base/errors.h"
#include "pipeline/image/read_image.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {

void picture(const std::uint8_t* data, std::size_t size) {
  constexpr int kMostPixels = 1 << 20;  // larger ones would take the time of many others
  const auto file = input_file(text_of(data, size));
  try {
    const ImageLayout layout = InputImage(file).layout();
    if (layout.width > kMostPixels / layout.height ||
        layout.place.width > kMostPixels / layout.place.height)
      return;
    read_light_image(file, PixelEncoding::kOfFile);
  } catch (const InputError&) {
  }
}

}  // namespace domefall::fuzz
