// Other people's images of the whole sky become .sky files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/image/read_image.h"
#include "pipeline/sources/sky/healpix_map.h"
#include "pipeline/sources/sky/orientation.h"

namespace domefall {

// The text of a .sky file of the microwave background has a line that begins like this.
inline constexpr const char* kMicrowaveBackground = "microwave background: ";

enum class SkyProjection {
  kOfFile,  // HEALPix for a FITS file, equirectangular for any other
  kEquirectangular,
  kHealpix,
};

struct SkyImport {
  std::filesystem::path image, out;
  SkyProjection projection = SkyProjection::kOfFile;
  // An equirectangular panorama lies on the sky like this.  A HEALPix map uses only the frame.
  Orientation orientation;
  bool frame_given = false;  // otherwise a HEALPix map says which one it has
  // The value 1 of the image stands for this many cd/m^2 [kPanoramaUnit].  With cmb it stands for
  // this many kelvin [what the file says].
  std::optional<double> unit;
  PixelEncoding encoding = PixelEncoding::kOfFile;
  int size = 0;    // texels along an edge of a face; 0 for the image's own detail
  int column = 1;  // column of a HEALPix file
  std::optional<CmbSettings> cmb;
  std::string text;                    // lines added to the file's own: licence, credit
  std::optional<double> fainter_than;  // SkyOrigin::fainter_than
};

// The text of a .sky file of a picture has a line that begins like this (LightImage::taken).
inline constexpr const char* kTakenAs = "taken as: ";
// Returns the rest of that line of a text, or nothing.
std::string taken_in(const std::string& text);

// Writes the file and returns the orientation that it states.  Throws InputError naming the image
// if it cannot be read or is of the wrong kind or shape, if all of its pixels are missing, or if
// none exceeds 0 and some are below.
Orientation import_sky(const SkyImport& import);

}  // namespace domefall
