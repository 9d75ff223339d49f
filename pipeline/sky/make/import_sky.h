// From other people's images of the whole sky to .sky files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/image/light_image.h"
#include "pipeline/sky/make/microwave_background.h"
#include "pipeline/sky/maps/orientation.h"

namespace domefall {

// How the line begins by which the text of a .sky file says that it holds the microwave background.
inline constexpr const char* kMicrowaveBackground = "microwave background: ";

enum class SkyProjection {
  kOfFile,  // HEALPix for a FITS file, equirectangular for any other
  kEquirectangular,
  kHealpix,
};

struct SkyImport {
  std::filesystem::path image, out;
  SkyProjection projection = SkyProjection::kOfFile;
  // That of an equirectangular panorama.  For a HEALPix map only the frame counts.
  Orientation orientation;
  bool frame_given = false;  // otherwise a HEALPix map is asked for its own
  // What the value 1 of the image is: cd/m^2 [kPanoramaUnit]; with cmb: kelvin [what the file
  // says].
  std::optional<double> unit;
  PixelEncoding encoding = PixelEncoding::kOfFile;
  int size = 0;    // of a face; 0 for the image's own detail
  int column = 1;  // of a HEALPix file
  std::optional<CmbSettings> cmb;
  std::string text;                    // lines that are added to the file's own: licence, credit
  std::optional<double> fainter_than;  // SkyOrigin::fainter_than
};

// Writes the file and returns the orientation that it states.  Throws InputError naming the image
// if it cannot be read or is not what it should be: if all of its pixels are missing, or if none
// exceeds 0 and some are below.
Orientation import_sky(const SkyImport& import);

}  // namespace domefall
