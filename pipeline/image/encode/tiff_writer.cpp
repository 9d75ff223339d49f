#include <tiffio.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pipeline/base/deflate.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/image/encode/alpha.h"
#include "pipeline/image/encode/dither.h"
#include "pipeline/image/encode/picture_writers.h"

namespace domefall {
namespace {

class TiffStrip {
 public:
  void make(const RowPicture& picture, const TiffHead& head, int first, int end) {
    const auto width = static_cast<std::size_t>(picture.width);
    codes_.resize(3 * width * static_cast<std::size_t>(end - first));
    picture.rows(first, end, codes_.data());
    const int rows = end - first;
    const std::size_t channels = head.opaque ? 4 : 3;
    if (!head.eight_bits) {
      if (head.opaque) codes_ = with_alpha(codes_.data(), picture.width, first, rows, head.opaque);
      take_differences(codes_, width, channels);
      deflater_.pack_stream({reinterpret_cast<const char*>(codes_.data()), 2 * codes_.size()},
                            packed_);
      return;
    }
    bytes_.resize(codes_.size());
    dither_rows(codes_.data(), picture.width, rows, first, head.frame, bytes_.data());
    if (head.opaque) bytes_ = with_alpha(bytes_.data(), picture.width, first, rows, head.opaque);
    take_differences(bytes_, width, channels);
    deflater_.pack_stream({reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}, packed_);
  }

  const ByteBlock& packed() const { return packed_; }

 private:
  // By TIFF 6.0, section 14, each sample is stored less that of the pixel on its left.
  template <class Sample>
  static void take_differences(std::vector<Sample>& samples, std::size_t width,
                               std::size_t channels) {
    const std::size_t row_samples = width * channels;
    for (std::size_t row = 0; row < samples.size(); row += row_samples)
      for (std::size_t k = row_samples; k-- > channels;)
        samples[row + k] = static_cast<Sample>(samples[row + k] - samples[row + k - channels]);
  }

  std::vector<unsigned short> codes_;
  std::vector<std::uint8_t> bytes_;
  ByteBlock packed_;
  Deflater deflater_;
};

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

// The strips come in their order, packed, and then finish() once.  All throw std::runtime_error.  The
// pixels are RGB or RGBA, packed by deflate after each sample is reduced by that on its left.
class TiffFile {
 public:
  TiffFile(ByteSink& sink, const RowPicture& picture, const TiffHead& head, int rows_per_strip)
      : bytes_{sink},
        tiff_(TIFFClientOpen("frame", "wl", &bytes_, TiffBytes::read, TiffBytes::write,
                             TiffBytes::seek, TiffBytes::close, TiffBytes::count, nullptr, nullptr),
              TIFFClose) {
    require_tiff(tiff_ != nullptr);
    set(TIFFTAG_IMAGEWIDTH, picture.width);
    set(TIFFTAG_IMAGELENGTH, picture.height);
    set(TIFFTAG_BITSPERSAMPLE, head.eight_bits ? 8 : 16);
    set(TIFFTAG_SAMPLESPERPIXEL, head.opaque ? 4 : 3);
    const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
    if (head.opaque) set(TIFFTAG_EXTRASAMPLES, 1, &alpha);
    set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    set(TIFFTAG_ROWSPERSTRIP, rows_per_strip);
    // A unit has as many more rows as a pixel is wider than high.
    if (head.pixel_aspect != 1) {
      constexpr double kColumns = 72;
      set(TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
      set(TIFFTAG_XRESOLUTION, kColumns);
      set(TIFFTAG_YRESOLUTION, kColumns * head.pixel_aspect);
    }
    set(TIFFTAG_IMAGEDESCRIPTION, head.description.c_str());
    if (!head.profile.empty())
      set(TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(head.profile.size()), head.profile.data());
  }

  // libtiff's type for the bytes is a writable one, since it swaps them in place on machines of the
  // other order.  Those of a raw strip are only read.
  void write_strip(int strip, std::string_view packed) {
    const auto size = static_cast<tmsize_t>(packed.size());
    require_tiff(TIFFWriteRawStrip(tiff_.get(), static_cast<std::uint32_t>(strip),
                                   const_cast<char*>(packed.data()), size) == size);
  }

  void finish() { require_tiff(TIFFWriteDirectory(tiff_.get()) == 1); }

 private:
  template <class... Value>
  void set(std::uint32_t tag, Value... value) {
    require_tiff(TIFFSetField(tiff_.get(), tag, value...) == 1);
  }

  TiffBytes bytes_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff_;
};

}  // namespace

void write_tiff(ByteSink& sink, const RowPicture& picture, const TiffHead& head) {
  static_assert(std::endian::native == std::endian::little, "samples stand in the file as here");
  const int rows = rows_of_strip(picture.width, picture.height),
            strips = (picture.height + rows - 1) / rows;
  TiffFile file(sink, picture, head, rows);
  make_in_order<TiffStrip>(
      strips,
      [&](int strip, TiffStrip& made) {
        made.make(picture, head, strip * rows, std::min((strip + 1) * rows, picture.height));
      },
      [&](int strip, TiffStrip& made) { file.write_strip(strip, made.packed().view()); });
  file.finish();
}

}  // namespace domefall
