#include "pipeline/image/encode/tiff_writer.h"

#include <tiffio.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <vector>

#include "pipeline/image/encode/deflate.h"
#include "pipeline/image/encode/dither.h"
#include "pipeline/image/encode/side_by_side.h"

namespace domefall {
namespace {

// libtiff's view of a sink.
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

class TiffStrip {
 public:
  void make(const RowPicture& picture, const TiffHead& head, int first, int end) {
    const auto width = static_cast<std::size_t>(picture.width);
    codes_.resize(3 * width * static_cast<std::size_t>(end - first));
    picture.rows(first, end, codes_.data());
    if (!head.eight_bits) {
      take_differences(codes_.data(), 3 * width);
      deflater_.pack_stream({reinterpret_cast<const char*>(codes_.data()), 2 * codes_.size()},
                            packed_);
      return;
    }
    bytes_.resize(codes_.size());
    dither_rows(codes_.data(), picture.width, end - first, first, head.frame, bytes_.data());
    take_differences(bytes_.data(), 3 * width);
    deflater_.pack_stream({reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}, packed_);
  }

  ByteBlock& packed() { return packed_; }

 private:
  // TIFF 6.0, section 14: each sample less that of the pixel on its left.
  template <class Sample>
  void take_differences(Sample* samples, std::size_t row_samples) const {
    for (std::size_t row = 0; row < codes_.size(); row += row_samples)
      for (std::size_t k = row_samples; k-- > 3;)
        samples[row + k] = static_cast<Sample>(samples[row + k] - samples[row + k - 3]);
  }

  std::vector<unsigned short> codes_;
  std::vector<std::uint8_t> bytes_;
  ByteBlock packed_;
  Deflater deflater_;
};

}  // namespace

void write_tiff(ByteSink& sink, const RowPicture& picture, const TiffHead& head) {
  static_assert(std::endian::native == std::endian::little, "samples stand in the file as here");
  TiffBytes bytes{sink};
  const std::unique_ptr<TIFF, void (*)(TIFF*)> file(
      TIFFClientOpen("frame", "wl", &bytes, TiffBytes::read, TiffBytes::write, TiffBytes::seek,
                     TiffBytes::close, TiffBytes::count, nullptr, nullptr),
      TIFFClose);
  require_tiff(file != nullptr);
  const int rows = rows_of_strip(picture.width, picture.height),
            strips = (picture.height + rows - 1) / rows;
  const auto set = [&](std::uint32_t tag, auto... value) {
    require_tiff(TIFFSetField(file.get(), tag, value...) == 1);
  };
  set(TIFFTAG_IMAGEWIDTH, picture.width);
  set(TIFFTAG_IMAGELENGTH, picture.height);
  set(TIFFTAG_BITSPERSAMPLE, head.eight_bits ? 8 : 16);
  set(TIFFTAG_SAMPLESPERPIXEL, 3);
  set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  set(TIFFTAG_ROWSPERSTRIP, rows);
  set(TIFFTAG_IMAGEDESCRIPTION, head.description.c_str());
  if (!head.profile.empty())
    set(TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(head.profile.size()), head.profile.data());
  make_in_order<TiffStrip>(
      strips,
      [&](int strip, TiffStrip& made) {
        made.make(picture, head, strip * rows, std::min((strip + 1) * rows, picture.height));
      },
      [&](int strip, TiffStrip& made) {
        const auto size = static_cast<tmsize_t>(made.packed().size());
        require_tiff(TIFFWriteRawStrip(file.get(), static_cast<std::uint32_t>(strip),
                                       made.packed().data(), size) == size);
      });
  require_tiff(TIFFWriteDirectory(file.get()) == 1);
}

}  // namespace domefall
