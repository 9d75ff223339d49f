// This file reads what a picture's file says of its pixels: how they are encoded, which primaries
// they have, how the picture lies, what its alpha means.  It looks into the file itself, since
// OpenImageIO tells only a part, and each version of it another.  OpenEXR's attributes are few, and
// all versions tell them (exr_claims).
#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/regular_file.h"

namespace domefall {

enum class Alpha {
  kNone,
  kAssociated,    // colours are multiplied by it already: they are light over black
  kUnassociated,  // colours are yet to be multiplied by it
};

// Code points of ITU-T H.273, as PNG's chunk cICP has them.
struct CodePoints {
  int primaries = 0, transfer = 0, matrix = 0, full_range = 1;
};

struct PictureClaims {
  int orientation = 1;                      // of EXIF and TIFF, 1 to 8
  bool has_profile = false;                 // an ICC profile is in the file
  std::string profile;                      // its bytes, where OpenImageIO does not give them
  std::optional<CodePoints> code_points;    // PNG: cICP
  bool srgb = false;                        // PNG: sRGB
  std::optional<double> gamma;              // PNG: the exponent that encodes, of gAMA
  std::optional<std::array<double, 8>> xy;  // CIE x, y of red, green, blue and white
  std::string xy_from;                      // what states them
  std::array<double, 3> scale{1, 1, 1};     // of the values to the light that they stand for
  int colours = 0;                          // TIFF: 1 for grey, 3; others' channels tell
  Alpha alpha = Alpha::kNone;               // of TIFF, whose alpha may be any channel
  int alpha_channel = -1;
  std::vector<std::string> notes;  // what is said and makes no difference
};

// Returns what a PNG, TIFF, JPEG, Radiance or WebP file says.  The format is as picture_format()
// says, and `path` is for messages.  Throws std::runtime_error with the reason if the file says
// what cannot be obeyed (CMYK, an animation), or is damaged where it says so.
PictureClaims picture_claims(std::string_view format, const RegularFile& file,
                             const std::filesystem::path& path);

// Returns what the attributes of an OpenEXR part say.  Throws as above.
PictureClaims exr_claims(const OIIO::ImageSpec& spec);

// ---- TIFF 6.0, and EXIF, which is written in the same way ----

// Throws std::runtime_error.
[[noreturn]] void refuse(const std::string& why);

// A Stretch is a part of a file that has numbers of its own, counted from its beginning.
struct Stretch {
  const RegularFile& file;
  const std::filesystem::path& path;
  std::uint64_t begin, size;
  bool big_endian = true;

  Stretch part(std::uint64_t at, std::uint64_t count) const;
  // Returns fewer bytes at the end.
  std::string bytes(std::uint64_t at, std::uint64_t count) const;
  // Throws as refuse() beyond the end.
  std::uint64_t number(std::uint64_t at, std::size_t count) const;
};

// Refuses an ICC profile that is too large.  They have 4 MB at most in practice.
void check_profile_size(std::uint64_t bytes);

// Does what picture_claims() says, for a TIFF.
PictureClaims tiff_claims(const Stretch& file);

// Takes what EXIF says in a JPEG, PNG or WebP: how the picture lies, and whether it is Adobe RGB.
void take_exif(const Stretch& stretch, PictureClaims& claims);

}  // namespace domefall
