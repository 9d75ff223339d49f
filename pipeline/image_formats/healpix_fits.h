// This file reads HEALPix maps by CFITSIO.
#pragma once

#include "pipeline/image/read_healpix.h"

namespace domefall {

// Does what read_healpix.h says of read_healpix().
HealpixFile read_healpix_fits(const std::filesystem::path& path, int column);

}  // namespace domefall
