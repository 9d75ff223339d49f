#include "pipeline/cli/output_file.h"

#include "pipeline/image/errors.h"

namespace domefall {

void refuse_overwriting(const std::filesystem::path& out, const std::filesystem::path& input) {
  std::error_code neither;  // set if one of them does not exist, and then they are not the same
  if (std::filesystem::equivalent(out, input, neither) && !neither)
    throw InputError("--out " + out.string() + ": that is the file to be read; name another");
}

}  // namespace domefall
