#include "pipeline/cli/input_file.h"

#include "pipeline/image/errors.h"

namespace domefall {

void require_file(const std::filesystem::path& input) {
  std::error_code error;
  if (std::filesystem::status(input, error).type() == std::filesystem::file_type::not_found)
    throw InputError(input.string() + ": No such file or directory");
}

}  // namespace domefall
