// An InputImage is a picture that the user names.  It may be any of kPictureFormats, whatever the
// file is called.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/image/image_formats.h"

namespace domefall {

class InputImage {
 public:
  // Reads the header.  Throws as RegularFile, and InputError naming the file if it is of another
  // format or damaged, has more than 32768 pixels a side, 32768 x 16384 pixels or 64 channels, or
  // states more pixels than a file of its length can hold.
  explicit InputImage(const std::filesystem::path& file);

  const ImageLayout& layout() const { return reader_->layout(); }
  // These read as ImageReader::read.  They throw InputError naming the file.
  void read(unsigned short* rgb) const;
  void read(int first, int end, float* rgb) const;
  // Throws InputError naming the file and the pixel, which the message counts from 1 instead of 0.
  [[noreturn]] void fail_not_finite(int x, int y) const;

 private:
  std::filesystem::path file_;
  std::unique_ptr<ImageReader> reader_;
};

// Applies the curve of IEC 61966-2-1.
float linear_from_srgb(float v);

}  // namespace domefall
