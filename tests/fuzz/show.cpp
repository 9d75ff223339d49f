// Show files, and the state of their first and last frames.
#include "pipeline/base/errors.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/show/frame_state.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {

void show(const std::uint8_t* data, std::size_t size) {
  try {
    const Show show = read_show(input_file(text_of(data, size), "show.yaml"));
    frame_state(show, 0);
    frame_state(show, frame_count(show) - 1);
  } catch (const InputError&) {
  } catch (const TemporaryError&) {  // it names a file that is not there
  }
}

}  // namespace domefall::fuzz
