#include "pipeline/image/encode/exr_writer.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "pipeline/image/encode/deflate.h"
#include "pipeline/image/encode/exr_zip.h"
#include "pipeline/image/encode/side_by_side.h"

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

// Adds attributes to a file's header, by their kind.
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
  void operator()(const ExrTimeCode& t) const {
    const exr_attr_timecode_t value{t.time_and_flags, 0};
    require(exr_attr_set_timecode(file, 0, name, &value));
  }
};

// Says whether the channels are those for which our own packer is made.
bool is_rgb(const ExrPicture& picture) {
  return std::ranges::equal(picture.channels, std::array{"R", "G", "B"});
}

// An ExrInTheMaking is a file whose header is written and whose pixels are to follow.
class ExrInTheMaking {
 public:
  ExrInTheMaking(ByteSink& sink, const ExrPicture& picture) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.user_data = &sink;
    how.write_fn = write_bytes;
    how.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    require(exr_start_write(&file_, "frame", EXR_WRITE_FILE_DIRECTLY, &how));
    try {
      write_header(picture);
    } catch (...) {
      exr_finish(&file_);
      throw;
    }
  }
  ~ExrInTheMaking() { exr_finish(&file_); }
  ExrInTheMaking(const ExrInTheMaking&) = delete;
  ExrInTheMaking(ExrInTheMaking&&) = delete;
  ExrInTheMaking& operator=(const ExrInTheMaking&) = delete;
  ExrInTheMaking& operator=(ExrInTheMaking&&) = delete;

  exr_context_t file() const { return file_; }

 private:
  void write_header(const ExrPicture& picture) {
    int part = 0;
    require(exr_add_part(file_, nullptr, EXR_STORAGE_SCANLINE, &part));
    require(exr_initialize_required_attr_simple(file_, part, picture.width, picture.height,
                                                code_of(picture.compression)));
    const exr_pixel_type_t type =
        std::visit([](const auto* pixels) { return type_of(pixels); }, picture.pixels);
    const auto meaning = is_rgb(picture) ? EXR_PERCEPTUALLY_LOGARITHMIC : EXR_PERCEPTUALLY_LINEAR;
    for (const std::string& channel : picture.channels)
      require(exr_add_channel(file_, part, channel.c_str(), type, meaning, 1, 1));
    for (const auto& [name, value] : picture.attributes)
      std::visit(AttributeAdder{file_, name.c_str()}, value);
    require(exr_write_header(file_));
  }

  exr_context_t file_ = nullptr;
};

// Makes blocks of rows ready to be written, one after the other in the same memory.
class BlockEncoder {
 public:
  BlockEncoder() = default;
  ~BlockEncoder() {
    if (begun_) exr_encoding_destroy(pipeline_.context, &pipeline_);
  }
  BlockEncoder(const BlockEncoder&) = delete;
  BlockEncoder(BlockEncoder&&) = delete;
  BlockEncoder& operator=(const BlockEncoder&) = delete;
  BlockEncoder& operator=(BlockEncoder&&) = delete;

  void encode(exr_context_t file, const ExrPicture& picture, int first_row) {
    exr_chunk_info_t block;
    require(exr_write_scanline_chunk_info(file, 0, first_row, &block));
    const bool zip = (picture.compression == ExrCompression::kZip ||
                      picture.compression == ExrCompression::kZips) &&
                     is_rgb(picture);
    const std::size_t channels = picture.channels.size();
    const auto encode_rows = [&](const auto* first) {
      const auto* rows = first + static_cast<std::size_t>(first_row) *
                                     static_cast<std::size_t>(picture.width) * channels;
      if (zip)
        bytes_ = zip_.pack(rows, picture.width, block.height);
      else
        run(file, block, rows, picture.channels);
    };
    std::visit(encode_rows, picture.pixels);
  }
  // Returns the block as it stands in the file.
  std::string_view bytes() const { return bytes_; }

 private:
  // This is done by OpenEXR's own steps, but for the last, which writes.
  template <class T>
  void run(exr_context_t file, const exr_chunk_info_t& block, const T* rows,
           const std::vector<std::string>& names) {
    require(begun_ ? exr_encoding_update(file, 0, &block, &pipeline_)
                   : exr_encoding_initialize(file, 0, &block, &pipeline_));
    begun_ = true;
    for (int c = 0; c < pipeline_.channel_count; ++c) {
      exr_coding_channel_info_t& channel = pipeline_.channels[c];
      const auto place = std::find(names.begin(), names.end(), channel.channel_name);
      channel.encode_from_ptr =
          reinterpret_cast<const std::uint8_t*>(rows + (place - names.begin()));
      channel.user_bytes_per_element = sizeof(T);
      channel.user_data_type = static_cast<std::uint16_t>(type_of(rows));
      channel.user_pixel_stride = static_cast<std::int32_t>(names.size() * sizeof(T));
      channel.user_line_stride = channel.user_pixel_stride * block.width;
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
  std::string_view bytes_;
};

}  // namespace

void write_exr(ByteSink& sink, const ExrPicture& picture) {
  const ExrInTheMaking made(sink, picture);
  int rows = 0, blocks = 0;
  require(exr_get_scanlines_per_chunk(made.file(), 0, &rows));
  require(exr_get_chunk_count(made.file(), 0, &blocks));
  make_in_order<BlockEncoder>(
      blocks,
      [&](int block, BlockEncoder& encoder) { encoder.encode(made.file(), picture, rows * block); },
      [&](int block, const BlockEncoder& encoder) {
        const std::string_view bytes = encoder.bytes();
        require(exr_write_scanline_chunk(made.file(), 0, rows * block, bytes.data(), bytes.size()));
      });
}

}  // namespace domefall
