// An image file that the user names, of any format OpenImageIO reads.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/image/image_formats.h"

namespace domefall {

class InputImage {
 public:
  // Throws InputError naming the file if it cannot be read or has more than 32768 pixels a side.
  explicit InputImage(const std::filesystem::path& file);

  const ImageLayout& layout() const { return reader_->layout(); }
  // As ImageReader::read.  Throws InputError naming the file.
  void read(int first, int end, float* rgb) const;
  // Throws InputError naming the file and the pixel, which the message counts from 1 instead of 0.
  [[noreturn]] void fail_not_finite(int x, int y) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path file_;
  std::unique_ptr<ImageReader> reader_;
};

// IEC 61966-2-1.
float linear_from_srgb(float v);

}  // namespace domefall
