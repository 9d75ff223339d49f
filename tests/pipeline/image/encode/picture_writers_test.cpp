// PNG, TIFF and JPEG, as another program's readers see them.
#include "pipeline/image/encode/picture_writers.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <lcms2.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "pipeline/base/digest.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/side_by_side.h"
#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/frame_buffer.h"
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

// cli/packed_bytes.sh compares what this prints with what it prints on other processors.
TEST_F(PictureWriters, PackIntoTheSameBytesByAnyNumberOfThreads) {
  const GradedFrame frame = gradient_frame(300, 200);
  const auto digest_by = [&](int threads) {
    set_encoder_threads(threads);
    Digest digest;
    for (const bool eight_bits : {false, true})
      digest.add(contents(png(frame, eight_bits))).add(contents(tiff(frame, eight_bits)));
    digest.add(contents(jpeg(frame, 95)));
    return digest.hex();
  };
  const std::string packed = digest_by(2);
  EXPECT_EQ(digest_by(1), packed);
  std::cout << "packed bytes: " << packed << "\n";
}

using Curve = DisplayColour::Curve;
constexpr DisplayColour kDome22{Curve::kPower, 2.2, kRec709Places},
    kCinema{Curve::kPower, 2.6, kP3D65Places}, kScreen{Curve::kSrgb, 2.2, kRec709Places};

std::map<std::string, std::string> chunks_of(const DisplayColour& colour) {
  std::map<std::string, std::string> chunks;
  for (const PngChunk& chunk : png_colour_chunks(colour))
    chunks[std::string(chunk.name)] = chunk.data;
  return chunks;
}

unsigned number_at(const std::string& bytes, std::size_t k = 0) {
  unsigned value = 0;
  for (std::size_t at = 4 * k; at < 4 * k + 4; ++at)
    value = value << 8 | static_cast<unsigned char>(bytes[at]);
  return value;
}

TEST(DisplayColourChunks, SayThePowerOfADomeAndNotSrgb) {
  auto chunks = chunks_of(kDome22);
  EXPECT_EQ(number_at(chunks["gAMA"]), 45455U);
  EXPECT_EQ(number_at(chunks["cHRM"], 0), 31270U);  // the white comes first
  EXPECT_EQ(number_at(chunks["cHRM"], 2), 64000U);
  EXPECT_FALSE(chunks.contains("sRGB"));
}

TEST(DisplayColourChunks, SayThePowerAndThePrimariesOfACinema) {
  auto chunks = chunks_of(kCinema);
  EXPECT_FALSE(chunks.contains("sRGB"));
  EXPECT_EQ(number_at(chunks["gAMA"]), 38462U);
  EXPECT_EQ(number_at(chunks["cHRM"], 2), 68000U);
}

TEST(DisplayColourChunks, SaySrgbOfSrgbAlone) {
  auto chunks = chunks_of(kScreen);
  EXPECT_EQ(chunks["sRGB"], std::string(1, '\0'));
}

// The code points of ITU-T H.273, RGB and full range, which no gAMA contradicts.
TEST(DisplayColourChunks, SayPqAndHlgByCodePoints) {
  auto pq = chunks_of({Curve::kPq, 2.2, kRec2020Places});
  EXPECT_EQ(pq["cICP"], std::string("\x09\x10\x00\x01", 4));
  EXPECT_FALSE(pq.contains("gAMA"));
  EXPECT_EQ(chunks_of({Curve::kPq, 2.2, kP3D65Places})["cICP"], std::string("\x0c\x10\x00\x01", 4));
  EXPECT_EQ(chunks_of({Curve::kHlg, 2.2, kRec2020Places})["cICP"],
            std::string("\x09\x12\x00\x01", 4));
  EXPECT_FALSE(chunks_of(kDome22).contains("cICP"));
}

// As another program converts codes by it: to the light of the display.
TEST(IccProfiles, TakeCodesToTheLightOfTheDisplay) {
  for (const DisplayColour& colour : {kDome22, kCinema, kScreen}) {
    const std::string bytes = icc_profile(colour);
    const auto profile = cmsOpenProfileFromMem(bytes.data(), static_cast<unsigned>(bytes.size()));
    ASSERT_TRUE(profile);
    const auto xyz = cmsCreateXYZProfile();
    const auto transform = cmsCreateTransform(profile, TYPE_RGB_DBL, xyz, TYPE_XYZ_DBL,
                                              INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE);
    ASSERT_TRUE(transform);
    for (const double code : {0.02, 0.1, 0.5, 0.9}) {
      const double grey[] = {code, code, code};
      double light[3] = {};
      cmsDoTransform(transform, grey, light, 1);
      const double wanted = colour.curve == Curve::kPower ? std::pow(code, colour.gamma)
                            : code <= 0.04045             ? code / 12.92
                                                          : std::pow((code + 0.055) / 1.055, 2.4);
      EXPECT_NEAR(light[1], wanted, 1e-4) << code;
    }
    cmsDeleteTransform(transform);
    cmsCloseProfile(xyz);
    cmsCloseProfile(profile);
  }
}

TEST(IccProfiles, HaveNoMomentOfTheirMaking) {
  const std::string bytes = icc_profile(kDome22);
  EXPECT_EQ(bytes.substr(24, 12), std::string("\x07\xb2\0\x01\0\x01\0\0\0\0\0\0", 12));
  EXPECT_EQ(bytes, icc_profile(kDome22));
}

}  // namespace
}  // namespace domefall
