// What the program asks of OpenImageIO and CFITSIO.  The first brings some 240 other libraries, and
// to load them all takes 0.17 s of CPU; the second brings 25 for files on servers.  Whatever calls
// them is therefore a library of its own, libdomefall_image_formats.so (pipeline/image_formats),
// which is loaded when the first image is read or written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace domefall {

struct HealpixFile;

// How an image file holds its numbers.  kFloat has 32 or 64 bits.
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

// What stands on one side of the library and is used on the other.
class Interface {
 public:
  Interface() = default;
  virtual ~Interface() = default;
  Interface(const Interface&) = delete;
  Interface(Interface&&) = delete;
  Interface& operator=(const Interface&) = delete;
  Interface& operator=(Interface&&) = delete;
};

class ImageReader : public Interface {
 public:
  virtual const ImageLayout& layout() const = 0;

  // Rows first <= y < end to rgb[end - first][width][3]; first is a multiple of layout().band, and
  // end is another or the height.  Integers are divided by their greatest value, grey is spread to
  // RGB, and channels beyond the third are dropped.  Throws std::runtime_error with the library's
  // reason.
  virtual void read(int first, int end, float* rgb) = 0;

  // The whole of an image of three channels to rgb[height][width][3].  Throws as above.
  virtual void read(unsigned short* rgb) = 0;
};

// Where an encoder puts the bytes of a file.  It sees no errors of the disk: NewFile keeps them.
class ImageSink : public Interface {
 public:
  virtual void write(std::string_view piece) = 0;
  virtual void seek(std::uint64_t position) = 0;
  virtual std::uint64_t position() const = 0;
  virtual std::uint64_t size() const = 0;
};

// An image of 16 bits and three channels, whose rows are given from the top.
class ImageWriter : public Interface {
 public:
  // rgb[count][width][3].  Throws std::runtime_error with the library's reason.
  virtual void write(const unsigned short* rgb, int count) = 0;
  // Once all rows are there.  Throws as above.
  virtual void close() = 0;
};

class ImageFormats : public Interface {
 public:
  // A picture as InputImage takes it, and with its bounds.  Throws as RegularFile, and otherwise
  // std::runtime_error with a reason that does not name the file.
  virtual std::unique_ptr<ImageReader> open(const std::filesystem::path& file) const = 0;

  // PNG or TIFF by the file's extension.  The bytes go to `sink`, which must outlive the writer.
  // They depend on the arguments and the rows alone.  Throws as above.
  virtual std::unique_ptr<ImageWriter> create(const std::filesystem::path& file, ImageSink& sink,
                                              int width, int height,
                                              const std::string& description) const = 0;

  // read_healpix.h
  virtual HealpixFile read_healpix(const std::filesystem::path& path, int column) const = 0;
};

// Loads the library when it is first called, from any thread.  Throws std::runtime_error naming
// what cannot be loaded.
const ImageFormats& image_formats();

}  // namespace domefall
