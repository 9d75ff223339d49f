// This file reads all-sky maps in the HEALPix pixelisation (Gorski et al. 2005, ApJ 622, 759) from
// FITS files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

struct HealpixFile {
  int nside = 1;                   // a power of two
  bool nested = false;             // else RING
  std::string coordinates, units;  // COORDSYS and TUNITn, as written; empty where there are none
  std::vector<float> values;       // 12 nside^2; bad pixels are NaN
};

// Reads column `column` (from 1) of the first binary table that is a HEALPix map of the whole sky,
// within the first 100 extensions.  The column has floats or integers, one pixel or many in a row.
// NSIDE is 8192 at most.  Throws as RegularFile, and InputError naming the file for anything that
// is wrong in it.
HealpixFile read_healpix(const std::filesystem::path& path, int column);

}  // namespace domefall
