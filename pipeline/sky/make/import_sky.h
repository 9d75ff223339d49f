// From other people's pictures of the whole sky to .sky files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/image/light_image.h"
#include "pipeline/sky/make/microwave_background.h"
#include "pipeline/sky/maps/orientation.h"

namespace domefall {

enum class SkyProjection {
  kOfFile,  // HEALPix of a FITS file, equirectangular of any other
  kEquirectangular,
  kHealpix,
};

struct SkyImport {
  std::filesystem::path image, out;
  SkyProjection projection = SkyProjection::kOfFile;
  // Of an equirectangular picture; of a HEALPix map only the frame counts.
  Orientation orientation;
  bool frame_given = false;  // else a HEALPix map is asked for its own
  // Value 1 of the image: cd/m^2 [kPanoramaUnit]; with cmb: kelvin [what the file says].
  std::optional<double> unit;
  PixelEncoding encoding = PixelEncoding::kOfFile;
  int size = 0;    // of a face; 0: the image's own detail
  int column = 1;  // of a HEALPix file
  std::optional<CmbSettings> cmb;
  std::string text;  // lines that are added to the file's own: licence, credit
};

// Writes the file and returns the orientation that it states.  Throws InputError naming the image if
// it cannot be read or is not what it should be: all pixels missing, or none above 0 and some below.
Orientation import_sky(const SkyImport& import);

}  // namespace domefall
