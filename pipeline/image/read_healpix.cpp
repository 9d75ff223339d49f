#include "pipeline/image/read_healpix.h"

#include "pipeline/image/image_formats.h"

namespace domefall {

HealpixFile read_healpix(const std::filesystem::path& path, int column) {
  return image_formats().read_healpix(path, column);
}

}  // namespace domefall
