// Frames that a run finds in its folder: what they say of themselves, and their pixels.
#include "pipeline/base/errors.h"
#include "pipeline/image/frame_check.h"
#include "pipeline/image/frame_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {

void frame(const std::uint8_t* data, std::size_t size) {
  const auto file = input_file(text_of(data, size), "input.exr");
  const WantedFrame wanted{"key", "title", "domemaster", 16, 16};
  try {
    check_frame(file, wanted);
    read_frame(file);
  } catch (const InputError&) {
  }
}

}  // namespace domefall::fuzz
