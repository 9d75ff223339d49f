#include "pipeline/image/encode/exr_writer.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "pipeline/base/deflate.h"
#include "pipeline/base/side_by_side.h"

namespace domefall {
namespace {

void require(exr_result_t result) {
  if (result != EXR_ERR_SUCCESS)
    throw std::runtime_error(std::string("OpenEXR: ") + exr_get_error_code_as_string(result));
}

exr_compression_t code_of(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::kZip:
      return EXR_COMPRESSION_ZIP;
    case ExrCompression::kZips:
      return EXR_COMPRESSION_ZIPS;
    case ExrCompression::kPiz:
      return EXR_COMPRESSION_PIZ;
    case ExrCompression::kNone:
      break;
  }
  return EXR_COMPRESSION_NONE;
}

exr_pixel_type_t type_of(const Imath::half*) { return EXR_PIXEL_HALF; }
exr_pixel_type_t type_of(const float*) { return EXR_PIXEL_FLOAT; }

std::int64_t write_bytes(exr_const_context_t, void* sink, const void* bytes, std::uint64_t count,
                         std::uint64_t position, exr_stream_error_func_ptr_t) {
  auto& to = *static_cast<ByteSink*>(sink);
  to.seek(position);
  to.write({static_cast<const char*>(bytes), count});
  return static_cast<std::int64_t>(count);
}

struct AttributeAdder {
  exr_context_t file;
  const char* name;

  void operator()(const std::string& text) const {
    require(exr_attr_set_string(file, 0, name, text.c_str()));
  }
  void operator()(int number) const { require(exr_attr_set_int(file, 0, name, number)); }
  void operator()(double number) const { require(exr_attr_set_double(file, 0, name, number)); }
  void operator()(const ExrChromaticities& c) const {
    exr_attr_chromaticities_t value;
    static_assert(sizeof value == sizeof c);
    std::memcpy(&value, &c, sizeof c);
    require(exr_attr_set_chromaticities(file, 0, name, &value));
  }
  void operator()(const ExrRational& r) const {
    const exr_attr_rational_t value{r.numerator, r.denominator};
    require(exr_attr_set_rational(file, 0, name, &value));
  }
  void operator()(const ExrMatrix& m) const {
    exr_attr_m44f_t value;
    static_assert(sizeof value == sizeof m);
    std::memcpy(&value, &m, sizeof m);
    require(exr_attr_set_m44f(file, 0, name, &value));
  }
  void operator()(const ExrTimeCode& t) const {
    const exr_attr_timecode_t value{t.time_and_flags, 0};
    require(exr_attr_set_timecode(file, 0, name, &value));
  }
};

// Says whether a channel is a colour, which is seen by the ratios of its numbers.
bool is_colour(std::string_view channel) {
  return channel == "R" || channel == "G" || channel == "B" || channel.ends_with(".R") ||
         channel.ends_with(".G") || channel.ends_with(".B");
}

exr_pixel_type_t type_of(const ExrChannel& channel) {
  return std::visit([](const auto* numbers) { return type_of(numbers); }, channel.numbers);
}

struct FinishExr {
  void operator()(exr_context_t file) const { exr_finish(&file); }
};
using ExrInTheMaking = std::unique_ptr<std::remove_pointer_t<exr_context_t>, FinishExr>;

ExrInTheMaking begin_exr(ByteSink& sink, const ExrPicture& picture) {
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.user_data = &sink;
  how.write_fn = write_bytes;
  how.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
  exr_context_t file = nullptr;
  require(exr_start_write(&file, "frame", EXR_WRITE_FILE_DIRECTLY, &how));
  ExrInTheMaking made(file);
  int part = 0;
  require(exr_add_part(file, nullptr, EXR_STORAGE_SCANLINE, &part));
  require(exr_initialize_required_attr_simple(file, part, picture.width, picture.height,
                                              code_of(picture.compression)));
  require(exr_set_pixel_aspect_ratio(file, part, static_cast<float>(picture.pixel_aspect)));
  for (const ExrChannel& channel : picture.channels)
    require(exr_add_channel(
        file, part, channel.name.c_str(), type_of(channel),
        is_colour(channel.name) ? EXR_PERCEPTUALLY_LOGARITHMIC : EXR_PERCEPTUALLY_LINEAR, 1, 1));
  for (const auto& [name, value] : picture.attributes)
    std::visit(AttributeAdder{file, name.c_str()}, value);
  require(exr_write_header(file));
  return made;
}

// Takes the words of 16 bits of a channel's row, the lower of a number first.
std::uint16_t* append_words(const Imath::half* number, std::ptrdiff_t step, int count,
                            std::uint16_t* out) {
  if (!number) return std::fill_n(out, count, std::uint16_t{0});
  for (int x = 0; x < count; ++x) out[x] = number[x * step].bits();
  return out + count;
}
std::uint16_t* append_words(const float* number, std::ptrdiff_t step, int count,
                            std::uint16_t* out) {
  if (!number) return std::fill_n(out, 2 * static_cast<std::ptrdiff_t>(count), std::uint16_t{0});
  for (int x = 0; x < count; ++x) {
    const auto bits = std::bit_cast<std::uint32_t>(number[x * step]);
    out[2 * x] = static_cast<std::uint16_t>(bits);
    out[2 * x + 1] = static_cast<std::uint16_t>(bits >> 16);
  }
  return out + 2 * static_cast<std::ptrdiff_t>(count);
}

// Returns the number of words of a row of all channels.
std::size_t words_in_row(const ExrPicture& picture) {
  std::size_t in_pixel = 0;
  for (const ExrChannel& channel : picture.channels)
    in_pixel += std::holds_alternative<const float*>(channel.numbers) ? 2 : 1;
  return in_pixel * static_cast<std::size_t>(picture.width);
}

// Takes the words of a row as a file has them, which is the channels one after the other, in the
// order of their names.
void take_words(const ExrPicture& picture, int row, std::uint16_t* out) {
  for (const ExrChannel& channel : picture.channels)
    std::visit(
        [&](const auto* numbers) {
          const std::ptrdiff_t first = numbers ? channel.step * picture.width * row : 0;
          out = append_words(numbers + first, channel.step, picture.width, out);
        },
        channel.numbers);
}

// A byte is stored less the one before it, plus this.
constexpr int kMiddle = 128;
unsigned char difference(int byte, int before) {
  return static_cast<unsigned char>(byte - before + kMiddle);
}

// Takes the differences of the low bytes and of the high bytes of `count` words, from the one that
// stands before the words.
void take_differences(const std::uint16_t* words, std::size_t count, unsigned char* low_bytes,
                      unsigned char* high_bytes) {
  // Nothing overlaps, which a compiler must know to take many at a time.
  const std::uint16_t* __restrict const word = words;
  unsigned char* __restrict const low = low_bytes;
  unsigned char* __restrict const high = high_bytes;
  for (std::size_t k = 0; k < count; ++k) {
    low[k] = difference(word[k], word[k - 1]);
    high[k] = difference(word[k] >> 8, word[k - 1] >> 8);
  }
}

// This is the ZIP compression of OpenEXR, packed by ISA-L.
class ExrZip {
 public:
  // Packs some rows.  They are a zlib stream of the bytes' differences ("OpenEXR File Layout"), or
  // the bytes as they are where that would be no smaller.  The bytes are there until the next rows.
  std::string_view pack(const ExrPicture& picture, int first_row, int height) {
    const std::size_t in_row = words_in_row(picture);
    bytes_.reserve(2 * in_row * static_cast<std::size_t>(height));
    bytes_.set_size(2 * in_row * static_cast<std::size_t>(height));
    // The words of one row and the word before it.
    row_.resize(in_row + 1);
    take_all_differences(picture, first_row, height);
    deflater_.pack_stream(bytes_.view(), packed_);
    if (packed_.size() < bytes_.size()) return packed_.view();
    for (int row = 0; row < height; ++row) {
      take_words(picture, first_row + row, row_.data());
      std::memcpy(bytes_.data() + 2 * in_row * static_cast<std::size_t>(row), row_.data(),
                  2 * in_row);
    }
    return bytes_.view();
  }

 private:
  // All low bytes come first and then all high ones.  Before the first low byte there is none, and
  // before the first high byte there is the last low byte.  Only one row of words is there at a
  // time, since those of all channels and rows would not stay in the cache.
  void take_all_differences(const ExrPicture& picture, int first_row, int height) {
    const std::size_t in_row = row_.size() - 1;
    unsigned char *low = bytes_.data(), *high = low + bytes_.size() / 2;
    unsigned char* const first_high = high;
    int first_word = 0;
    row_[0] = kMiddle;  // leaves the first byte as it is
    for (int row = 0; row < height; ++row, low += in_row, high += in_row) {
      take_words(picture, first_row + row, row_.data() + 1);
      if (row == 0) first_word = row_[1];
      take_differences(row_.data() + 1, in_row, low, high);
      row_[0] = row_[in_row];
    }
    *first_high = difference(first_word >> 8, row_[0]);
  }

  Deflater deflater_;
  std::vector<std::uint16_t> row_;
  ByteBlock bytes_, packed_;
};

// Makes blocks of rows ready to be written, one after the other in the same memory.
class BlockEncoder {
 public:
  BlockEncoder() = default;
  ~BlockEncoder() {
    if (begun_) exr_encoding_destroy(pipeline_.context, &pipeline_);
  }
  BlockEncoder(const BlockEncoder&) = delete;
  BlockEncoder& operator=(const BlockEncoder&) = delete;

  void encode(exr_context_t file, const ExrPicture& picture, int first_row) {
    exr_chunk_info_t block;
    require(exr_write_scanline_chunk_info(file, 0, first_row, &block));
    if (picture.compression == ExrCompression::kZip || picture.compression == ExrCompression::kZips)
      bytes_ = zip_.pack(picture, first_row, block.height);
    else
      run(file, block, picture, first_row);
  }
  std::string_view bytes() const { return bytes_; }

 private:
  // This is done by OpenEXR's own steps, but for the last, which writes.
  void run(exr_context_t file, const exr_chunk_info_t& block, const ExrPicture& picture,
           int first_row) {
    require(begun_ ? exr_encoding_update(file, 0, &block, &pipeline_)
                   : exr_encoding_initialize(file, 0, &block, &pipeline_));
    begun_ = true;
    black_.resize(sizeof(float) * static_cast<std::size_t>(picture.width) *
                  static_cast<std::size_t>(block.height));
    for (std::size_t c = 0; c < picture.channels.size(); ++c) {
      exr_coding_channel_info_t& to = pipeline_.channels[c];
      const ExrChannel& from = picture.channels[c];
      std::visit(
          [&](const auto* numbers) {
            const std::ptrdiff_t step = numbers ? from.step : 1;
            const std::ptrdiff_t first = step * picture.width * first_row;
            to.encode_from_ptr =
                numbers ? reinterpret_cast<const std::uint8_t*>(numbers + first) : black_.data();
            to.user_bytes_per_element = sizeof *numbers;
            to.user_data_type = static_cast<std::uint16_t>(type_of(numbers));
            to.user_pixel_stride =
                static_cast<std::int32_t>(step * static_cast<int>(sizeof *numbers));
            to.user_line_stride = to.user_pixel_stride * picture.width;
          },
          from.numbers);
    }
    require(exr_encoding_choose_default_routines(file, 0, &pipeline_));
    pipeline_.yield_until_ready_fn = nullptr;
    pipeline_.write_fn = nullptr;
    require(exr_encoding_run(file, 0, &pipeline_));
    bytes_ = {static_cast<const char*>(pipeline_.compressed_buffer), pipeline_.compressed_bytes};
  }

  ExrZip zip_;
  exr_encode_pipeline_t pipeline_{};
  bool begun_ = false;
  std::vector<std::uint8_t> black_;  // what a channel without numbers has
  std::string_view bytes_;
};

}  // namespace

void write_exr(ByteSink& sink, const ExrPicture& picture) {
  ExrPicture sorted = picture;
  // So a file has them.
  std::ranges::sort(sorted.channels, {}, &ExrChannel::name);
  const ExrInTheMaking made = begin_exr(sink, sorted);
  int rows = 0, blocks = 0;
  require(exr_get_scanlines_per_chunk(made.get(), 0, &rows));
  require(exr_get_chunk_count(made.get(), 0, &blocks));
  make_in_order<BlockEncoder>(
      blocks,
      [&](int block, BlockEncoder& encoder) { encoder.encode(made.get(), sorted, rows * block); },
      [&](int block, const BlockEncoder& encoder) {
        const std::string_view bytes = encoder.bytes();
        require(exr_write_scanline_chunk(made.get(), 0, rows * block, bytes.data(), bytes.size()));
      });
}

}  // namespace domefall
