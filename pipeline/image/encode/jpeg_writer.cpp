// clang-format off
#include <cstdio>  // jpeglib.h needs it before
#include <jpeglib.h>
// clang-format on

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "pipeline/base/ratio.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/image/encode/dither.h"
#include "pipeline/image/encode/picture_writers.h"

namespace domefall {
namespace {

// libjpeg puts its bytes here.
struct JpegBytes {
  jpeg_destination_mgr manager{};
  ByteSink& sink;
  std::array<JOCTET, 65536> block{};

  explicit JpegBytes(ByteSink& to) : sink(to) {
    manager.init_destination = [](j_compress_ptr) {};
    manager.empty_output_buffer = [](j_compress_ptr jpeg) -> boolean {
      of(jpeg).take(of(jpeg).block.size());
      return TRUE;
    };
    manager.term_destination = [](j_compress_ptr jpeg) {
      of(jpeg).take(of(jpeg).block.size() - of(jpeg).manager.free_in_buffer);
    };
    begin();
  }

 private:
  static JpegBytes& of(j_compress_ptr jpeg) { return *static_cast<JpegBytes*>(jpeg->client_data); }
  void begin() {
    manager.next_output_byte = block.data();
    manager.free_in_buffer = block.size();
  }
  void take(std::size_t count) {
    sink.write({reinterpret_cast<const char*>(block.data()), count});
    begin();
  }
};

[[noreturn]] void throw_jpeg_error(j_common_ptr jpeg) {
  std::array<char, JMSG_LENGTH_MAX> message{};
  jpeg->err->format_message(jpeg, message.data());
  throw std::runtime_error(std::string("libjpeg: ") + message.data());
}

class JpegInTheMaking {
 public:
  JpegInTheMaking(ByteSink& sink, const RowPicture& picture, const JpegHead& head) : bytes_(sink) {
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = throw_jpeg_error;
    jpeg_create_compress(&jpeg_);
    jpeg_.dest = &bytes_.manager;
    jpeg_.client_data = &bytes_;
    jpeg_.image_width = static_cast<JDIMENSION>(picture.width);
    jpeg_.image_height = static_cast<JDIMENSION>(picture.height);
    jpeg_.input_components = 3;
    jpeg_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, head.quality, TRUE);
    const Ratio aspect = ratio_of(head.pixel_aspect);
    jpeg_.X_density = static_cast<UINT16>(aspect.under);
    jpeg_.Y_density = static_cast<UINT16>(aspect.over);
    jpeg_.dct_method = JDCT_ISLOW;  // whose bits are the same on all processors
    jpeg_.comp_info[0].h_samp_factor = jpeg_.comp_info[0].v_samp_factor = 1;
  }
  ~JpegInTheMaking() { jpeg_destroy_compress(&jpeg_); }
  JpegInTheMaking(const JpegInTheMaking&) = delete;
  JpegInTheMaking& operator=(const JpegInTheMaking&) = delete;

  jpeg_compress_struct& jpeg() { return jpeg_; }

 private:
  jpeg_error_mgr errors_{};
  JpegBytes bytes_;
  jpeg_compress_struct jpeg_{};
};

struct JpegStrip {
  std::vector<unsigned short> codes;
  std::vector<std::uint8_t> bytes;
};

}  // namespace

void write_jpeg(ByteSink& sink, const RowPicture& picture, const JpegHead& head) {
  JpegInTheMaking made(sink, picture, head);
  jpeg_compress_struct& jpeg = made.jpeg();
  jpeg_start_compress(&jpeg, TRUE);
  jpeg_write_marker(&jpeg, JPEG_COM, reinterpret_cast<const JOCTET*>(head.comment.data()),
                    static_cast<unsigned>(head.comment.size()));
  if (!head.profile.empty())
    jpeg_write_icc_profile(&jpeg, reinterpret_cast<const JOCTET*>(head.profile.data()),
                           static_cast<unsigned>(head.profile.size()));
  const int rows = rows_of_strip(picture.width, picture.height),
            strips = (picture.height + rows - 1) / rows;
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(picture.width);
  make_in_order<JpegStrip>(
      strips,
      [&](int strip, JpegStrip& made_rows) {
        const int first = strip * rows, end = std::min(first + rows, picture.height);
        made_rows.codes.resize(row_bytes * static_cast<std::size_t>(end - first));
        made_rows.bytes.resize(made_rows.codes.size());
        picture.rows(first, end, made_rows.codes.data());
        dither_rows(made_rows.codes.data(), picture.width, end - first, first, head.frame,
                    made_rows.bytes.data());
      },
      [&](int, JpegStrip& made_rows) {
        for (std::size_t at = 0; at < made_rows.bytes.size(); at += row_bytes) {
          JSAMPROW row = made_rows.bytes.data() + at;
          jpeg_write_scanlines(&jpeg, &row, 1);
        }
      });
  jpeg_finish_compress(&jpeg);
}

}  // namespace domefall
