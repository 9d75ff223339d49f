#include "pipeline/image/tiff_writer.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

#include "pipeline/image/encode/deflate.h"
#include "pipeline/image/encode/dither.h"
#include "pipeline/image/encode/side_by_side.h"
#include "pipeline/image/tiff_file.h"

namespace domefall {
namespace {

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

  const ByteBlock& packed() const { return packed_; }

 private:
  // By TIFF 6.0, section 14, each sample is stored less that of the pixel on its left.
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
  const int rows = rows_of_strip(picture.width, picture.height),
            strips = (picture.height + rows - 1) / rows;
  const std::unique_ptr<TiffFile> file = begin_tiff(sink, {.width = picture.width,
                                                           .height = picture.height,
                                                           .bits = head.eight_bits ? 8 : 16,
                                                           .rows_per_strip = rows,
                                                           .description = head.description,
                                                           .profile = head.profile});
  make_in_order<TiffStrip>(
      strips,
      [&](int strip, TiffStrip& made) {
        made.make(picture, head, strip * rows, std::min((strip + 1) * rows, picture.height));
      },
      [&](int strip, TiffStrip& made) { file->write_strip(strip, made.packed().view()); });
  file->finish();
}

}  // namespace domefall
