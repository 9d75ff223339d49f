#include "pipeline/image/some_light.h"

#include <fmt/core.h>

#include "pipeline/image/errors.h"

namespace domefall {

void check_light(const std::filesystem::path& file, double least, double most) {
  if (most > 0 || !(least < 0)) return;
  throw InputError(
      fmt::format("{}: there is no light in it: no value exceeds 0, and they go down to {:.4g}",
                  file.string(), least));
}

}  // namespace domefall
