#include "pipeline/image/encode/exr_writer.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <random>

#include "pipeline/base/new_file.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/image/frame_buffer.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

struct Compression {
  ExrCompression ours;
  const char* name;  // OpenImageIO's
};
constexpr Compression kCompressions[] = {{ExrCompression::kZip, "zip"},
                                         {ExrCompression::kZips, "zips"},
                                         {ExrCompression::kPiz, "piz"},
                                         {ExrCompression::kNone, "none"}};

class ExrWriter : public TestFolder {
 protected:
  ~ExrWriter() override { set_encoder_threads(0); }

  template <class T>
  std::filesystem::path written(const ImageRgb<T>& frame, ExrCompression compression) const {
    const auto path = folder_ / "f.exr";
    NewFile file(path);
    write_exr(file, {frame.width,
                     frame.height,
                     interleaved({"R", "G", "B"}, frame.pixels.data()),
                     compression,
                     {{"digest", std::string("0123")}, {"rate", ExrRational{30000, 1001}}}});
    file.commit();
    return path;
  }
};

HalfFrame smooth(int width, int height) {
  HalfFrame frame(width, height);
  for (int y = 0; y < height; ++y)
    for (int k = 0; k < 3 * width; ++k)
      frame.row(y)[k] = 0.01f * static_cast<float>(k) + 0.3f * static_cast<float>(y);
  return frame;
}

HalfFrame random_bits(int width, int height) {
  HalfFrame frame(width, height);
  std::mt19937 random(3);
  for (auto& value : frame.pixels)
    value.setBits(static_cast<unsigned short>(random() & 0xfbff));  // none of them is no number
  return frame;
}

// Read by another program's reader.
TEST_F(ExrWriter, GivesBackEveryBitInEveryCompression) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(70, 67), std::pair(5, 16)})
    for (const HalfFrame& frame : {smooth(width, height), random_bits(width, height)})
      for (const Compression& compression : kCompressions) {
        const auto in = OIIO::ImageInput::open(written(frame, compression.ours).string());
        ASSERT_TRUE(in) << OIIO::geterror();
        HalfFrame read(width, height);
        ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::HALF, read.pixels.data()))
            << in->geterror();
        EXPECT_EQ(std::memcmp(read.pixels.data(), frame.pixels.data(), 2 * frame.pixels.size()), 0)
            << compression.name << " " << width << " x " << height;
        EXPECT_EQ(in->spec().get_string_attribute("compression"), compression.name);
        EXPECT_EQ(in->spec().get_string_attribute("digest"), "0123");
      }
}

// Numbers that are not there are zeros, byte for byte, whatever stands beside them.
TEST_F(ExrWriter, TakesChannelsWithoutNumbersForZeros) {
  constexpr int kWidth = 37, kHeight = 67;
  const HalfFrame frame = smooth(kWidth, kHeight), black(kWidth, kHeight);
  const std::vector<float> clear(std::size_t{kWidth} * kHeight);
  const auto bytes = [&](const Imath::half* numbers, const float* alpha, ExrCompression how) {
    ExrPicture picture{kWidth, kHeight, interleaved({"R", "G", "B"}, frame.pixels.data()), how};
    for (const ExrChannel& channel : interleaved({"D.R", "D.G", "D.B"}, numbers))
      picture.channels.push_back(channel);
    picture.channels.push_back({"A", alpha});
    NewFile file(folder_ / "f.exr");
    write_exr(file, picture);
    file.commit();
    return read_file(folder_ / "f.exr", std::uint64_t{1} << 30);
  };
  for (const Compression& compression : kCompressions)
    EXPECT_EQ(bytes(nullptr, nullptr, compression.ours),
              bytes(black.pixels.data(), clear.data(), compression.ours))
        << compression.name;
}

TEST_F(ExrWriter, GivesBackEveryBitOfFloats) {
  std::mt19937 random(4);
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(70, 67), std::pair(5, 16)})
    for (const unsigned kept : {0xff7fffffU, 0x3f7f0000U})  // noise, and what can be packed
      for (const Compression& compression : kCompressions) {
        FloatImage frame(width, height);
        for (float& value : frame.pixels)
          value = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & kept);
        const auto in = OIIO::ImageInput::open(written(frame, compression.ours).string());
        ASSERT_TRUE(in) << OIIO::geterror();
        EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
        FloatImage read(width, height);
        ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, read.pixels.data()))
            << in->geterror();
        EXPECT_EQ(std::memcmp(read.pixels.data(), frame.pixels.data(), 4 * frame.pixels.size()), 0)
            << compression.name << " " << width << " x " << height;
      }
}

// Layers of names in no order, which a file has sorted, in blocks of more rows than there are.
TEST_F(ExrWriter, GivesBackOtherChannelsByTheirNames) {
  constexpr int kWidth = 33, kHeight = 37;
  const std::vector<std::string> names{"sky.x", "st.t", "light.order", "A", "st.s"};
  std::vector<float> pixels(names.size() * kWidth * kHeight);
  std::mt19937 random(5);
  for (float& value : pixels)
    value = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0xff7fffffU);
  for (const Compression& compression : kCompressions) {
    const auto path = folder_ / "channels.exr";
    NewFile file(path);
    write_exr(file, {kWidth, kHeight, interleaved(names, pixels.data()), compression.ours});
    file.commit();
    const auto in = OIIO::ImageInput::open(path.string());
    ASSERT_TRUE(in) << OIIO::geterror();
    ASSERT_EQ(in->spec().nchannels, 5);
    for (std::size_t c = 0; c < names.size(); ++c) {
      const int at = in->spec().channelindex(names[c]);
      ASSERT_GE(at, 0) << names[c];
      std::vector<float> read(kWidth * kHeight);
      ASSERT_TRUE(in->read_image(0, 0, at, at + 1, OIIO::TypeDesc::FLOAT, read.data()));
      for (std::size_t k = 0; k < read.size(); ++k)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(read[k]),
                  std::bit_cast<std::uint32_t>(pixels[k * names.size() + c]))
            << names[c] << " " << compression.name;
    }
  }
}

// A layer's colours are halves, and its alpha is a float.
TEST_F(ExrWriter, GivesBackHalvesBesideFloats) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(70, 67), std::pair(5, 33)})
    for (const Compression& compression : kCompressions) {
      const HalfFrame frame = random_bits(width, height);
      std::vector<float> alpha(frame.pixels.size() / 3);
      for (std::size_t k = 0; k < alpha.size(); ++k) alpha[k] = 1 / (1 + static_cast<float>(k));
      const auto path = folder_ / "mixed.exr";
      NewFile file(path);
      std::vector<ExrChannel> channels =
          interleaved({"disc.R", "disc.G", "disc.B"}, frame.pixels.data());
      channels.push_back({"disc.A", alpha.data()});
      write_exr(file, {width, height, channels, compression.ours});
      file.commit();
      const auto in = OIIO::ImageInput::open(path.string());
      ASSERT_TRUE(in) << OIIO::geterror();
      std::vector<float> read(4 * alpha.size());
      ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, read.data()));
      const auto place = [&](const char* name) {
        return static_cast<std::size_t>(in->spec().channelindex(name));
      };
      for (std::size_t k = 0; k < alpha.size(); ++k) {
        ASSERT_EQ(read[4 * k + place("disc.A")], alpha[k]) << compression.name;
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_EQ(read[4 * k + place(channels[c].name.c_str())], float{frame.pixels[3 * k + c]})
              << compression.name;
      }
    }
}

// Blocks are written in the order in which they lie in the picture, whoever is ready first.
TEST_F(ExrWriter, HasTheSameBytesForAnyNumberOfThreads) {
  const HalfFrame frame = smooth(90, 700);
  for (const Compression& compression : kCompressions) {
    set_encoder_threads(0);
    const std::string alone = contents(written(frame, compression.ours));
    for (const int threads : {1, 2, 4}) {
      set_encoder_threads(threads);
      EXPECT_TRUE(contents(written(frame, compression.ours)) == alone) << compression.name;
    }
  }
}

TEST_F(ExrWriter, MakesNoBlockLargerThanItsPixels) {
  const HalfFrame frame = random_bits(300, 64);
  const auto size = [&](ExrCompression compression) {
    return std::filesystem::file_size(written(frame, compression));
  };
  EXPECT_EQ(size(ExrCompression::kZips), size(ExrCompression::kNone));
  EXPECT_LE(size(ExrCompression::kZip), size(ExrCompression::kNone));
}

}  // namespace
}  // namespace domefall
