#include <algorithm>
#include <cstdint>

#include "pipeline/base/deflate.h"
#include "pipeline/base/ratio.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/image/encode/alpha.h"
#include "pipeline/image/encode/dither.h"
#include "pipeline/image/encode/picture_writers.h"

namespace domefall {
namespace {

// Writes a chunk, whose name has four letters and whose data come in pieces.
void write_chunk(ByteSink& sink, std::string_view name,
                 std::initializer_list<std::string_view> data) {
  std::size_t length = 0;
  std::uint32_t crc = crc32_of(name);
  for (const std::string_view piece : data) length += piece.size(), crc = crc32_of(piece, crc);
  sink.write(png_number(static_cast<std::uint32_t>(length)));
  sink.write(name);
  for (const std::string_view piece : data) sink.write(piece);
  sink.write(png_number(crc));
}

// These are types of filter (the specification's 9.2).  The first row of a strip does not refer to
// the one above it, which another thread makes.
constexpr unsigned char kSub = 1, kUp = 2;

class PngStrip {
 public:
  void make(const RowPicture& picture, const PngHead& head, int first, int end) {
    const std::size_t pixel = (head.opaque ? 4 : 3) * (head.eight_bits ? 1 : 2),
                      row_bytes = pixel * static_cast<std::size_t>(picture.width);
    const auto rows = static_cast<std::size_t>(end - first);
    codes_.resize(3 * rows * static_cast<std::size_t>(picture.width));
    picture.rows(first, end, codes_.data());
    take_bytes(head, picture.width, first, end - first);
    filtered_.reserve(rows * (row_bytes + 1));
    filtered_.set_size(rows * (row_bytes + 1));
    unsigned char* out = filtered_.data();
    for (std::size_t row = 0; row < rows; ++row) {
      const unsigned char* in = bytes_.data() + row * row_bytes;
      *out++ = row == 0 ? kSub : kUp;
      const std::size_t back = row == 0 ? pixel : row_bytes, plain = row == 0 ? pixel : 0;
      for (std::size_t k = 0; k < plain; ++k) out[k] = in[k];
      const unsigned char* before = in + plain - back;
      for (std::size_t k = plain; k < row_bytes; ++k)
        out[k] = static_cast<unsigned char>(in[k] - before[k - plain]);
      out += row_bytes;
    }
    deflater_.pack_part(filtered_.view(), packed_);
    sum_ = adler32_of(filtered_.view());
  }

  std::string_view packed() const { return packed_.view(); }
  // These return the Adler-32 of the filtered rows and how many bytes they are.
  unsigned sum() const { return sum_; }
  std::size_t size() const { return filtered_.size(); }

 private:
  // Takes the codes as they stand in the file, before the filter.
  void take_bytes(const PngHead& head, int width, int first, int rows) {
    bytes_.reserve(codes_.size() / 3 * (head.opaque ? 4 : 3) * (head.eight_bits ? 1 : 2));
    if (head.eight_bits) {
      dither_rows(codes_.data(), width, rows, first, head.frame, bytes_.data());
      if (!head.opaque) return;
      const auto rgba = with_alpha(bytes_.data(), width, first, rows, head.opaque);
      std::copy(rgba.begin(), rgba.end(), bytes_.data());
      return;
    }
    if (head.opaque) codes_ = with_alpha(codes_.data(), width, first, rows, head.opaque);
    unsigned char* out = bytes_.data();
    for (const unsigned short code : codes_) {
      *out++ = static_cast<unsigned char>(code >> 8);
      *out++ = static_cast<unsigned char>(code);
    }
  }

  std::vector<unsigned short> codes_;
  ByteBlock bytes_, filtered_, packed_;
  Deflater deflater_;
  unsigned sum_ = 0;
};

std::string png_header(const RowPicture& picture, const PngHead& head) {
  constexpr char kRgb = 2, kRgba = 6;
  std::string data = png_number(static_cast<std::uint32_t>(picture.width)) +
                     png_number(static_cast<std::uint32_t>(picture.height));
  data += head.eight_bits ? '\x08' : '\x10';
  data += head.opaque ? kRgba : kRgb;
  return data + std::string(3, '\0');  // the only compression, the only filters, not interlaced
}

}  // namespace

std::string png_number(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::string png_checksum(std::string_view name_and_data) {
  return png_number(crc32_of(name_and_data));
}

PngChunk png_pixel_aspect(double width_over_height) {
  const Ratio aspect = ratio_of(width_over_height);
  return {"pHYs", png_number(static_cast<std::uint32_t>(aspect.under)) +
                      png_number(static_cast<std::uint32_t>(aspect.over)) + '\0'};
}

void write_png(ByteSink& sink, const RowPicture& picture, const PngHead& head) {
  sink.write("\x89PNG\r\n\x1a\n");
  write_chunk(sink, "IHDR", {png_header(picture, head)});
  for (const PngChunk& chunk : head.chunks) write_chunk(sink, chunk.name, {chunk.data});
  const int rows = rows_of_strip(picture.width, picture.height),
            strips = (picture.height + rows - 1) / rows;
  unsigned sum = 1;
  make_in_order<PngStrip>(
      strips,
      [&](int strip, PngStrip& made) {
        made.make(picture, head, strip * rows, std::min((strip + 1) * rows, picture.height));
      },
      [&](int strip, const PngStrip& made) {
        sum = adler32_joined(sum, made.sum(), made.size());
        const bool last = strip + 1 == strips;
        write_chunk(sink, "IDAT",
                    {strip == 0 ? kStreamStart : "", made.packed(), last ? kStreamEnd : "",
                     last ? png_number(sum) : std::string()});
      });
  write_chunk(sink, "IEND", {});
}

}  // namespace domefall
