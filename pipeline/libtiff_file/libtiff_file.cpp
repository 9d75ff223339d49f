#include <tiffio.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "pipeline/image/tiff_file.h"

namespace domefall {
namespace {

// TiffBytes let libtiff use a sink as a file.
struct TiffBytes {
  ByteSink& sink;
  std::uint64_t size = 0;

  static TiffBytes& of(thandle_t handle) { return *static_cast<TiffBytes*>(handle); }

  static tmsize_t read(thandle_t, void*, tmsize_t) { return 0; }
  static tmsize_t write(thandle_t handle, void* bytes, tmsize_t count) {
    TiffBytes& to = of(handle);
    to.sink.write({static_cast<const char*>(bytes), static_cast<std::size_t>(count)});
    to.size = std::max(to.size, to.sink.position());
    return count;
  }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    TiffBytes& to = of(handle);
    const toff_t from = whence == SEEK_END ? to.size : whence == SEEK_CUR ? to.sink.position() : 0;
    to.sink.seek(from + offset);
    return to.sink.position();
  }
  static int close(thandle_t) { return 0; }
  static toff_t count(thandle_t handle) { return of(handle).size; }
};

void require_tiff(bool done) {
  if (!done) throw std::runtime_error("libtiff could not write a part of the file");
}

class LibtiffFile : public TiffFile {
 public:
  LibtiffFile(ByteSink& sink, const TiffLayout& layout)
      : bytes_{sink},
        tiff_(TIFFClientOpen("frame", "wl", &bytes_, TiffBytes::read, TiffBytes::write,
                             TiffBytes::seek, TiffBytes::close, TiffBytes::count, nullptr, nullptr),
              TIFFClose) {
    require_tiff(tiff_ != nullptr);
    set(TIFFTAG_IMAGEWIDTH, layout.width);
    set(TIFFTAG_IMAGELENGTH, layout.height);
    set(TIFFTAG_BITSPERSAMPLE, layout.bits);
    set(TIFFTAG_SAMPLESPERPIXEL, 3);
    set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    set(TIFFTAG_ROWSPERSTRIP, layout.rows_per_strip);
    set(TIFFTAG_IMAGEDESCRIPTION, layout.description.c_str());
    if (!layout.profile.empty())
      set(TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(layout.profile.size()),
          layout.profile.data());
  }

  // libtiff's type for the bytes is a writable one, since it swaps them in place on machines of the
  // other order.  Those of a raw strip are only read.
  void write_strip(int strip, std::string_view packed) override {
    const auto size = static_cast<tmsize_t>(packed.size());
    require_tiff(TIFFWriteRawStrip(tiff_.get(), static_cast<std::uint32_t>(strip),
                                   const_cast<char*>(packed.data()), size) == size);
  }

  void finish() override { require_tiff(TIFFWriteDirectory(tiff_.get()) == 1); }

 private:
  template <class... Value>
  void set(std::uint32_t tag, Value... value) {
    require_tiff(TIFFSetField(tiff_.get(), tag, value...) == 1);
  }

  TiffBytes bytes_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff_;
};

class LibtiffFiles : public TiffFiles {
 public:
  std::unique_ptr<TiffFile> begin(ByteSink& sink, const TiffLayout& layout) const override {
    return std::make_unique<LibtiffFile>(sink, layout);
  }
};

}  // namespace
}  // namespace domefall

extern "C" const domefall::Interface* domefall_libtiff_file() {
  static const domefall::LibtiffFiles files;
  return &files;
}
