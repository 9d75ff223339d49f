// Configurations of OpenColorIO.  They are tried in a process of their own, which may crash.
#include "pipeline/base/errors.h"
#include "pipeline/grade/grader.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {

void colour_config(const std::uint8_t* data, std::size_t size) {
  GradeSettings settings;
  settings.config = input_file(text_of(data, size), "config.ocio");
  try {
    Grader grader(settings);
  } catch (const InputError&) {
  } catch (const TemporaryError&) {  // it names a file that is not there
  }
}

}  // namespace domefall::fuzz
