// ImageFormats are what the program asks of OpenImageIO and CFITSIO.  The first brings some 240
// other libraries, and to load them all takes 0.17 s of CPU.  The second brings 25 for files on
// servers.  Whatever calls them is therefore a library of its own, libdomefall_image_formats.so
// (pipeline/image_formats), which is loaded when the first image is read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "pipeline/image/late_library.h"

namespace domefall {

struct HealpixFile;

// A picture may be of these formats, which messages and help name.  picture_format() knows each by
// its first bytes.
inline constexpr std::string_view kPictureFormats =
    "OpenEXR, PNG, TIFF, JPEG, Radiance (HDR) or WebP";

// This says how an image file holds its numbers.  kFloat has 32 or 64 bits.
enum class SampleType { kUint16, kOtherInteger, kHalf, kFloat };

inline bool is_floating_point(SampleType type) {
  return type == SampleType::kHalf || type == SampleType::kFloat;
}

struct ImageLayout {
  int width = 0, height = 0, channels = 0;
  SampleType samples = SampleType::kOtherInteger;
  int band = 1;             // so many rows are best read at once
  std::string description;  // the text that the file holds about itself
};

class ImageReader : public Interface {
 public:
  virtual const ImageLayout& layout() const = 0;

  // Reads rows first <= y < end to rgb[end - first][width][3].  first is a multiple of
  // layout().band, and end is another or the height.  Integers are divided by their greatest value,
  // grey is spread to RGB, and channels beyond the third are dropped.  Throws std::runtime_error
  // with the library's reason.
  virtual void read(int first, int end, float* rgb) = 0;

  // Reads the whole of an image of three channels to rgb[height][width][3].  Throws as above.
  virtual void read(unsigned short* rgb) = 0;
};

class ImageFormats : public Interface {
 public:
  // Opens a picture as InputImage takes it, and with its bounds.  Throws as RegularFile, and
  // otherwise std::runtime_error with a reason that does not name the file.
  virtual std::unique_ptr<ImageReader> open(const std::filesystem::path& file) const = 0;

  // Does what read_healpix.h says.
  virtual HealpixFile read_healpix(const std::filesystem::path& path, int column) const = 0;
};

// Loads the library when it is first called, from any thread.  Throws as load_library.
const ImageFormats& image_formats();

}  // namespace domefall
