// The parts of a TIFF file around its pixels are written by libtiff, which brings the libraries of
// all packings that such a file may have.  What calls it is therefore a library of its own,
// libdomefall_libtiff_file.so (pipeline/libtiff_file), which is loaded for the first file.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "pipeline/image/encode/byte_sink.h"
#include "pipeline/image/late_library.h"

namespace domefall {

// The pixels are RGB without alpha, packed by deflate after each sample is reduced by that on its
// left.
struct TiffLayout {
  int width = 0, height = 0;
  int bits = 16;           // of a sample
  int rows_per_strip = 0;  // which are packed together
  std::string description;
  std::string profile;  // ICC; empty for none
};

class TiffFile : public Interface {
 public:
  // The strips come in their order, packed, and then finish() once.  Both throw std::runtime_error.
  virtual void write_strip(int strip, std::string_view packed) = 0;
  virtual void finish() = 0;
};

class TiffFiles : public Interface {
 public:
  virtual std::unique_ptr<TiffFile> begin(ByteSink& sink, const TiffLayout& layout) const = 0;
};

// Begins a file in `sink`, which outlives it.  Throws as load_library, and std::runtime_error.
std::unique_ptr<TiffFile> begin_tiff(ByteSink& sink, const TiffLayout& layout);

}  // namespace domefall
