// This file reads HEALPix maps by CFITSIO.
#pragma once

#include <string_view>

#include "pipeline/image/read_image.h"

namespace domefall {

// Does what read_image.h says of read_healpix().  `unpacked` is what a packed file holds, and is
// empty for any other.
HealpixFile read_healpix_fits(const std::filesystem::path& path, std::string_view unpacked,
                              int column);

}  // namespace domefall
