// ImageFormats are what the program asks of OpenImageIO and CFITSIO.  The first brings some 240
// other libraries, and to load them all takes 0.17 s of CPU.  The second brings 25 for files on
// servers.  Whatever calls them is therefore a library of its own, libdomefall_openimageio.so
// (pipeline/image/openimageio), which is loaded when the first image is read.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace domefall {

struct HealpixFile;

// A picture may be of these formats, which messages and help name.  picture_format() knows each by
// its first bytes.
inline constexpr std::string_view kPictureFormats =
    "OpenEXR, PNG, TIFF, JPEG, Radiance (HDR) or WebP";

// This says how the numbers of a file become light.
enum class PixelEncoding {
  kOfFile,  // as the file says of itself; otherwise integers are sRGB, and floats are linear
  kLinear,
  kSrgb,    // IEC 61966-2-1
  kStored,  // not at all: the first three channels are read as they are stored
};

// The pixels that are stored lie in a picture: perhaps in a part of it, perhaps beyond its edges,
// and perhaps on their side.
struct PicturePlace {
  int width = 0, height = 0;       // of the picture, upright
  std::int64_t left = 0, top = 0;  // of the first pixel, in the picture as it is stored
  int orientation = 1;             // 1 to 8, as EXIF counts

  // Returns where a stored pixel is in the upright picture, or nothing if it is outside.
  std::optional<std::pair<int, int>> of(int x, int y) const;
};

struct ImageLayout {
  int width = 0, height = 0, channels = 0;  // as they are stored
  bool may_exceed_half = false;             // values are larger, perhaps, than a half can be
  int band = 1;                             // so many rows are best read at once
  std::string description;                  // the text that the file holds about itself
  PicturePlace place;
  std::array<double, 8> xy{};  // of the light: CIE x, y of red, green, blue and white
  bool has_alpha = false;
};

// An Interface is what stands on one side of the library and is used on the other.
class Interface {
 public:
  Interface() = default;
  virtual ~Interface() = default;
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
};

class ImageReader : public Interface {
 public:
  virtual const ImageLayout& layout() const = 0;

  // Reads the stored rows first <= y < end to rgb[end - first][width][3].  first is a multiple of
  // layout().band, and end is another or the height.  These are linear light with alpha multiplied
  // in, or codes.  Integers are divided by their greatest value, and grey is spread to RGB.  Throws
  // std::runtime_error with the library's reason.
  virtual void read(int first, int end, float* rgb) = 0;

  // Says what was taken as what, for people: layer, size, encoding, primaries, alpha.  It says of
  // alpha what the rows that were read have shown.
  virtual std::string taken() const = 0;

  // Reads the whole of an image of three channels to rgb[height][width][3].  Throws as above.
  virtual void read(unsigned short* rgb) = 0;
};

class ImageFormats : public Interface {
 public:
  // Opens a picture as InputImage takes it, and with its bounds.  Throws as RegularFile, and
  // otherwise std::runtime_error with a reason that does not name the file.
  virtual std::unique_ptr<ImageReader> open(const std::filesystem::path& file,
                                            PixelEncoding encoding) const = 0;

  // Does what read_image.h says.  `unpacked` is what a packed file holds, and is empty for any
  // other.
  virtual HealpixFile read_healpix(const std::filesystem::path& path, std::string_view unpacked,
                                   int column) const = 0;
};

// Loads the library when it is first called, from any thread.  Throws TemporaryError if that fails.
const ImageFormats& image_formats();

}  // namespace domefall
