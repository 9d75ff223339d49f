// Which files are taken for pictures, and what their headers may say.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/pipeline/image/picture_bytes.h"

namespace domefall {
namespace {

using testing::HasSubstr;

// Headers of our own making, followed by little or nothing.

std::string png_header(std::uint64_t width, std::uint64_t height, bool interlaced = false) {
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR",
               be(width, 4) + be(height, 4) + "\x10\x02\0\0"s + (interlaced ? "\1" : "\0"s)) +
         chunk("IDAT", std::string(100, 'x')) + chunk("IEND", "");
}

std::string jpeg(std::uint64_t width, std::uint64_t height, char kind) {
  const std::string table = "\xff\xdb" + be(67, 2) + "\0"s + std::string(64, '\1');
  return "\xff\xd8"s + table + "\xff"s + kind + be(17, 2) + "\x08" + be(height, 2) + be(width, 2) +
         "\3\1\x11\0\2\x11\0\3\x11\0"s + "\xff\xda" + be(12, 2) + "\3\1\0\2\0\3\0\0\0\0"s +
         std::string(200, '\0');
}

std::string webp(std::uint64_t width, std::uint64_t height) {
  const std::string canvas =
      "VP8X" + le(10, 4) + std::string(4, '\0') + le(width - 1, 3) + le(height - 1, 3);
  return "RIFF" + le(4 + canvas.size(), 4) + "WEBP" + canvas;
}

std::string radiance(std::uint64_t width, std::uint64_t height) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n" + std::string(100, '\0');
}

// One strip, or tiles of `tile` pixels a side, at byte 8.
std::string tiff_header(std::uint64_t width, std::uint64_t height, std::uint64_t packing,
                        std::uint64_t tile = 0, std::uint64_t channels = 3) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> tags{
      {256, width}, {257, height}, {258, 8}, {259, packing}, {262, channels < 3 ? 1 : 2}};
  if (!tile) tags.emplace_back(273, 8);
  tags.emplace_back(277, channels);
  if (!tile) tags.insert(tags.end(), {{278, height}, {279, 100}});
  if (tile) tags.insert(tags.end(), {{322, tile}, {323, tile}, {324, 8}, {325, 100}});
  std::string out = "II*\0"s + le(108, 4) + std::string(100, '\0') + le(tags.size(), 2);
  for (const auto& [tag, value] : tags) out += le(tag, 2) + le(4, 2) + le(1, 4) + le(value, 4);
  return out + le(0, 4);
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + le(value.size(), 4) + value;
}

// With a table of chunks, 8 bytes for each 16 rows or, unless packed, each row.  All are missing.
std::string exr(std::uint64_t width, std::uint64_t height, char packing, std::uint64_t tile = 0,
                int channels = 3) {
  std::string names;
  for (int k = 0; k < channels; ++k)
    names += "c" + std::to_string(10000 + k) + '\0' + le(1, 4) + le(0, 4) + le(1, 4) + le(1, 4);
  const std::string window = le(0, 8) + le(width - 1, 4) + le(height - 1, 4);
  std::string out =
      "v/1\1" + le(tile ? 0x202 : 2, 4) + attribute("channels", "chlist", names + '\0') +
      attribute("compression", "compression", std::string(1, packing)) +
      attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
      attribute("lineOrder", "lineOrder", "\0"s) +
      attribute("pixelAspectRatio", "float", le(0x3f800000, 4)) +
      attribute("screenWindowCenter", "v2f", le(0, 8)) +
      attribute("screenWindowWidth", "float", le(0x3f800000, 4));
  if (tile) out += attribute("tiles", "tiledesc", le(tile, 4) + le(tile, 4) + "\0"s);
  return out + '\0' + std::string(packing < 3 ? 150000 : 35000, '\0');
}

class Pictures : public PictureColours {
 protected:
  void write(const fs::path& path, int width, int height) const {
    written(path, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8),
            std::vector<float>(3 * static_cast<std::size_t>(width * height), 0.5f));
  }
};

TEST_F(Pictures, AreKnownByTheirFirstBytesWhateverTheirName) {
  for (const char* format : {"exr", "png", "tif", "jpg", "hdr", "webp"})
    for (const char* name : {"picture", "picture.png", "picture.tif", "picture.iff"}) {
      const fs::path written = folder_ / ("written."s + format);
      write(written, 8, 4);
      fs::rename(written, folder_ / name);
      const FloatImage image = read_image(folder_ / name).pixels;
      EXPECT_EQ(image.width, 8) << format;
      EXPECT_NEAR(image.row(2)[5], format == "exr"s || format == "hdr"s ? 0.5 : 0.2159, 0.01)
          << format << " called " << name;
    }
}

// OpenImageIO reads all of these, and by several of them a damaged file writes beyond its memory.
TEST_F(Pictures, OfOtherFormatsAreRefusedWhateverTheirName) {
  for (const char* format : {"bmp", "dpx", "fits", "iff", "ppm", "sgi", "tga", "rla", "dds", "gif"})
    for (const char* name : {"picture.png", "picture.exr", "picture"}) {
      const fs::path written = folder_ / ("written."s + format);
      if (OIIO::ImageOutput::create(written.string()))
        write(written, 64, 32);
      else
        put(written, "DDS |\0\0\0"s);
      fs::rename(written, folder_ / name);
      EXPECT_THAT(message_of([&] { read_image(folder_ / name); }),
                  HasSubstr("by its first bytes it is not OpenEXR, PNG, TIFF, JPEG, Radiance"))
          << format << " called " << name;
    }
}

TEST_F(Pictures, WhoseHeadersStateTooMuchAreRefusedBeforeMemoryIsTaken) {
  const auto too_large = HasSubstr("1 to 32768 pixels a side, got "),
             too_many = HasSubstr("the image has more than 32768 x 16384 pixels");
  EXPECT_THAT(refusal(png_header(60000, 30000)), too_large);
  EXPECT_THAT(refusal(png_header(32768, 16385)), too_many);
  for (const char kind : {'\xc0', '\xc2'})
    EXPECT_THAT(refusal(jpeg(65500, 32750, kind)), too_large);
  EXPECT_THAT(refusal(jpeg(32768, 32768, '\xc2')), too_many);
  EXPECT_THAT(refusal(webp(1 << 24, 1 << 24)), too_large);
  EXPECT_THAT(refusal(radiance(0x7fffffff, 0x7fffffff)), too_large);
  EXPECT_THAT(refusal(tiff_header(60000, 30000, 1)), too_large);
  EXPECT_THAT(refusal(exr(60000, 60000, 3)), too_large);
  EXPECT_THAT(refusal(exr(64, 32, 3, 0, 65)), HasSubstr("must have 1 to 64 channels, got 65"));
  EXPECT_THAT(refusal(tiff_header(32, 16, 1, 0, 65)),
              HasSubstr("must have 1 to 64 channels, got 65"));
}

TEST_F(Pictures, ThatTheirFileCannotHoldAreRefusedBeforeMemoryIsTaken) {
  const std::string files[] = {png_header(32768, 16384),
                               png_header(32768, 16384, true),
                               radiance(32768, 16384),
                               tiff_header(32768, 16384, 1),
                               tiff_header(32768, 16384, 5),
                               tiff_header(32768, 16384, 8),
                               tiff_header(32768, 16384, 32773),
                               jpeg(32768, 16384, '\xc0'),
                               jpeg(32768, 16384, '\xc2'),
                               exr(32768, 16384, 0),
                               exr(32768, 16384, 1),
                               exr(32768, 16384, 3),
                               exr(32768, 16384, 3, 2048)};
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  for (const std::string& file : files)
    EXPECT_THAT(refusal(file), HasSubstr("bytes cannot hold 32768 x 16384 pixels"));
  getrusage(RUSAGE_SELF, &after);
  constexpr long kKilobytes = 400000;  // where the pixels would take 3 GB, and the libraries 130 MB
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, kKilobytes);
}

// OpenEXR would take 2 GB for it.
TEST_F(Pictures, InOpenExrWhoseHeaderHasAnAttributeLongerThanTheFileAreRefused) {
  std::string file = exr(64, 32, 3);
  file.insert(8, "note\0string\0"s + le(0x7fffff00, 4));
  EXPECT_THAT(refusal(file), HasSubstr("the file ends within its header"));
}

// The bound is the formats' own: a picture of one colour is packed as well as it can be.
TEST_F(Pictures, OfOneColourAreReadHoweverWellTheyArePacked) {
  for (const char* name : {"a.exr", "a.png", "a.tif", "a.jpg", "a.hdr", "a.webp"}) {
    write(folder_ / name, 2048, 1024);
    EXPECT_EQ(read_image(folder_ / name).pixels.height, 1024) << name;
  }
}

}  // namespace
}  // namespace domefall
