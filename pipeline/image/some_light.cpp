#include "pipeline/image/some_light.h"

#include <array>
#include <cstdio>

#include "pipeline/image/errors.h"

namespace domefall {

void check_light(const std::filesystem::path& file, double least, double most) {
  if (most > 0 || !(least < 0)) return;
  std::array<char, 32> number;
  std::snprintf(number.data(), number.size(), "%.4g", least);
  throw InputError(file.string() +
                   ": there is no light in it: no value exceeds 0, and they go down to " +
                   number.data());
}

}  // namespace domefall
