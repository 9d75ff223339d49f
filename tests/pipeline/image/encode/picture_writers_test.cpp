// PNG, TIFF and JPEG, as another program's readers see them.

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/image/digest.h"
#include "pipeline/image/encode/jpeg_writer.h"
#include "pipeline/image/encode/png_writer.h"
#include "pipeline/image/encode/side_by_side.h"
#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/new_file.h"
#include "pipeline/image/tiff_writer.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

class PictureWriters : public TestFolder {
 protected:
  ~PictureWriters() override { set_encoder_threads(0); }

  template <class Write>
  std::filesystem::path written(const char* name, Write write) const {
    const auto path = folder_ / name;
    NewFile file(path);
    write(file);
    file.commit();
    return path;
  }
  std::filesystem::path png(const GradedFrame& frame, bool eight_bits) const {
    return written("f.png", [&](NewFile& file) {
      write_png(file, picture(frame), {eight_bits, 3, {{"tEXt", std::string("A\0b", 3)}}});
    });
  }
  std::filesystem::path tiff(const GradedFrame& frame, bool eight_bits) const {
    return written("f.tif", [&](NewFile& file) {
      write_tiff(file, picture(frame), {eight_bits, 3, "a tiff", ""});
    });
  }
  std::filesystem::path jpeg(const GradedFrame& frame, int quality) const {
    return written("f.jpg", [&](NewFile& file) {
      write_jpeg(file, picture(frame), {quality, 3, "", "a jpeg"});
    });
  }

 private:
  static RowPicture picture(const GradedFrame& frame) {
    return {frame.width, frame.height, [&frame](int first, int end, unsigned short* rgb) {
              std::copy(frame.row(first), frame.row(end), rgb);
            }};
  }
};

GradedFrame random_frame(int width, int height) {
  GradedFrame frame(width, height);
  std::mt19937 random(8);
  for (auto& value : frame.pixels) value = static_cast<unsigned short>(random());
  return frame;
}

// Ridges of colour on a gradient, by whole numbers, which are the same on every processor.
GradedFrame gradient_frame(int width, int height) {
  GradedFrame frame(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        frame.row(y)[3 * x + c] = static_cast<unsigned short>(
            20'000 + 100 * x + 40 * std::abs((3 * (c + 1) * x + 5 * y) % 400 - 200));
  return frame;
}

GradedFrame read_back(const std::filesystem::path& path, OIIO::TypeDesc type) {
  const auto in = OIIO::ImageInput::open(path.string());
  EXPECT_TRUE(in) << OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  EXPECT_EQ(spec.format, type);
  EXPECT_EQ(spec.nchannels, 3);
  GradedFrame frame(spec.width, spec.height);
  EXPECT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT16, frame.pixels.data()))
      << in->geterror();
  return frame;
}

constexpr std::pair<int, int> kSizes[] = {{1, 1}, {3, 5}, {500, 300}, {20'000, 9}};

TEST_F(PictureWriters, KeepSixteenBits) {
  for (const auto& [width, height] : kSizes) {
    const GradedFrame frame = random_frame(width, height);
    EXPECT_EQ(read_back(png(frame, false), OIIO::TypeDesc::UINT16).pixels, frame.pixels) << width;
    EXPECT_EQ(read_back(tiff(frame, false), OIIO::TypeDesc::UINT16).pixels, frame.pixels) << width;
  }
}

TEST_F(PictureWriters, RoundToEightBitsAlike) {
  for (const auto& [width, height] : kSizes) {
    const GradedFrame frame = random_frame(width, height);
    const auto of_png = read_back(png(frame, true), OIIO::TypeDesc::UINT8),
               of_tiff = read_back(tiff(frame, true), OIIO::TypeDesc::UINT8);
    EXPECT_EQ(of_png.pixels, of_tiff.pixels);
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      ASSERT_LE(std::abs(of_png.pixels[k] - frame.pixels[k]), 1.5 * 257) << k;
  }
}

// The worst of JPEG's rounding, of the dithering and of quality 95 and 60, in steps of 8 bits.
TEST_F(PictureWriters, KeepAPhotographAsJpeg) {
  const GradedFrame frame = gradient_frame(300, 200);
  const auto error = [&](int quality) {
    const GradedFrame back = read_back(jpeg(frame, quality), OIIO::TypeDesc::UINT8);
    double sum = 0;
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      sum += std::pow((back.pixels[k] - frame.pixels[k]) / 257.0, 2);
    return std::sqrt(sum / static_cast<double>(frame.pixels.size()));
  };
  EXPECT_LT(error(95), 1.5);
  EXPECT_GT(error(30), 2 * error(95));
}

// 4:4:4: red and blue lines side by side keep their colours.
TEST_F(PictureWriters, KeepFineColoursAsJpeg) {
  GradedFrame frame(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) frame.row(y)[3 * x + (x % 2 ? 0 : 2)] = 50'000;
  const GradedFrame back = read_back(jpeg(frame, 95), OIIO::TypeDesc::UINT8);
  for (int x = 0; x < 64; ++x) {
    EXPECT_NEAR(back.row(30)[3 * x], x % 2 ? 50'000 : 0, 6000) << x;
    EXPECT_NEAR(back.row(30)[3 * x + 2], x % 2 ? 0 : 50'000, 6000) << x;
  }
}

// cli/packed_bytes.sh runs this for other processors.
TEST_F(PictureWriters, GivesTheBytesThatItGivesElsewhere) {
  const GradedFrame frame = gradient_frame(300, 200);
  set_encoder_threads(2);
  Digest digest;
  for (const bool eight_bits : {false, true})
    digest.add(contents(png(frame, eight_bits))).add(contents(tiff(frame, eight_bits)));
  digest.add(contents(jpeg(frame, 95)));
  EXPECT_EQ(digest.hex(), "882a5f33e15da9f21995d1db6aaede17");
}

}  // namespace
}  // namespace domefall
