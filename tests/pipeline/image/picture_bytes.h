// These functions make PNG and TIFF files byte by byte, and ICC profiles, for tests of what files say
// of their pixels.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <lcms2.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/read_image.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {

namespace fs = std::filesystem;
using namespace std::literals;

inline std::string ordered(std::uint64_t value, std::size_t bytes, bool big) {
  std::string out;
  for (std::size_t k = 0; k < bytes; ++k)
    out += static_cast<char>(value >> 8 * (big ? bytes - 1 - k : k));
  return out;
}
inline std::string be(std::uint64_t value, std::size_t bytes) {
  return ordered(value, bytes, true);
}
inline std::string le(std::uint64_t value, std::size_t bytes) {
  return ordered(value, bytes, false);
}

inline std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

inline std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return be(data.size(), 4) + body + be(crc, 4);
}

// A PNG of `row` after `row`; `row` has the filter's byte before its samples.
inline std::string png(int width, int height, int bits, int kind, const std::string& row,
                       const std::string& before, const std::string& after = "") {
  std::string rows;
  for (int y = 0; y < height; ++y) rows += '\0' + row;
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", be(static_cast<unsigned>(width), 4) + be(static_cast<unsigned>(height), 4) +
                           be(static_cast<unsigned>(bits), 1) + be(static_cast<unsigned>(kind), 1) +
                           "\0\0\0"s) +
         before + chunk("IDAT", deflated(rows)) + after + chunk("IEND", "");
}

// 4 x 2 pixels of 16 bits whose codes are nearly a half.
inline std::string half_png(const std::string& before, const std::string& after = "") {
  std::string row;
  for (int k = 0; k < 12; ++k) row += be(0x8000, 2);
  return png(4, 2, 16, 2, row, before, after);
}
inline constexpr double kHalf = 0x8000 / 65535.0;

inline double of_srgb(double v) { return std::pow((v + 0.055) / 1.055, 2.4); }

inline std::string gama(unsigned value) { return chunk("gAMA", be(value, 4)); }
inline std::string chrm(const std::array<double, 8>& xy) {
  std::string data;
  for (const std::size_t k : {6U, 7U, 0U, 1U, 2U, 3U, 4U, 5U})
    data += be(static_cast<std::uint32_t>(std::lround(xy[k] * 1e5)), 4);
  return chunk("cHRM", data);
}
inline std::string cicp(int primaries, int transfer, int matrix = 0, int range = 1) {
  std::string data;
  for (const int code : {primaries, transfer, matrix, range}) data += static_cast<char>(code);
  return chunk("cICP", data);
}
inline std::string iccp(const std::string& profile) {
  return chunk("iCCP", "a profile\0\0"s + deflated(profile));
}
const std::string kSrgbChunk = chunk("sRGB", "\0"s);

inline std::string linear_profile(const std::array<double, 8>& xy = kRec709Places) {
  return icc_profile({DisplayColour::Curve::kPower, 1, xy});
}

// Saves a profile that Little CMS holds, and closes it.
inline std::string saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  EXPECT_TRUE(cmsSaveProfileToMem(profile, nullptr, &size));
  std::string bytes(size, '\0');
  EXPECT_TRUE(cmsSaveProfileToMem(profile, bytes.data(), &size));
  cmsCloseProfile(profile);
  return bytes;
}

// A profile that says the way to Lab by a table alone, as scanners' do; that of sRGB.
inline std::string table_profile() {
  const cmsHPROFILE srgb = cmsCreate_sRGBProfile(), lab = cmsCreateLab4Profile(nullptr);
  const cmsHTRANSFORM to_lab =
      cmsCreateTransform(srgb, TYPE_RGB_16, lab, TYPE_Lab_16, INTENT_RELATIVE_COLORIMETRIC, 0);
  constexpr int kGrid = 33;
  cmsStage* table = cmsStageAllocCLut16bit(nullptr, kGrid, 3, 3, nullptr);
  cmsStageSampleCLut16bit(
      table,
      [](const cmsUInt16Number* in, cmsUInt16Number* out, void* transform) -> cmsInt32Number {
        cmsDoTransform(transform, in, out, 1);
        return 1;
      },
      to_lab, 0);
  cmsPipeline* pipeline = cmsPipelineAlloc(nullptr, 3, 3);
  // The format wants curves on either side.
  cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  cmsPipelineInsertStage(pipeline, cmsAT_END, table);
  cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  const cmsHPROFILE made = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(made, 4.3);
  cmsSetDeviceClass(made, cmsSigInputClass);
  cmsSetColorSpace(made, cmsSigRgbData);
  cmsSetPCS(made, cmsSigLabData);
  cmsWriteTag(made, cmsSigAToB0Tag, pipeline);
  cmsWriteTag(made, cmsSigMediaWhitePointTag, cmsD50_XYZ());
  cmsPipelineFree(pipeline);
  cmsDeleteTransform(to_lab);
  cmsCloseProfile(srgb);
  cmsCloseProfile(lab);
  return saved(made);
}

inline std::string placeholder(cmsProfileClassSignature kind, cmsColorSpaceSignature space) {
  const cmsHPROFILE made = cmsCreateProfilePlaceholder(nullptr);
  cmsSetDeviceClass(made, kind);
  cmsSetColorSpace(made, space);
  cmsSetPCS(made, cmsSigLabData);
  cmsWriteTag(made, cmsSigMediaWhitePointTag, cmsD50_XYZ());
  return saved(made);
}

// ---- TIFF: tags, and one strip ----

struct TiffTag {
  unsigned tag, type;
  std::vector<std::uint64_t> values;  // of a rational in millionths
};

// In a folder of tags the values of up to 4 bytes stand in the folder, the others after it.
inline std::string tiff_folder(const std::vector<TiffTag>& tags, std::size_t at) {
  constexpr std::array<std::size_t, 6> kSizes{0, 1, 1, 2, 4, 8};
  std::string entries = le(tags.size(), 2), rest;
  const std::size_t after = at + 2 + 12 * tags.size() + 4;
  for (const TiffTag& t : tags) {
    std::string values;
    for (const std::uint64_t v : t.values)
      values += t.type == 5 ? le(v, 4) + le(1000000, 4) : le(v, kSizes[t.type]);
    entries += le(t.tag, 2) + le(t.type, 2) + le(t.values.size(), 4);
    if (values.size() > 4) {
      entries += le(after + rest.size(), 4);
      rest += values;
    } else {
      entries += values + std::string(4 - values.size(), '\0');
    }
  }
  return entries + le(0, 4) + rest;
}

inline std::string tiff(unsigned width, unsigned height, unsigned samples, unsigned bits,
                        unsigned photometric, const std::string& strip,
                        const std::vector<TiffTag>& more = {}) {
  std::vector<TiffTag> tags{{256, 4, {width}},
                            {257, 4, {height}},
                            {258, 3, std::vector<std::uint64_t>(samples, bits)},
                            {259, 3, {1}},
                            {262, 3, {photometric}},
                            {273, 4, {8}},
                            {277, 3, {samples}},
                            {278, 4, {height}},
                            {279, 4, {strip.size()}}};
  tags.insert(tags.end(), more.begin(), more.end());
  std::sort(tags.begin(), tags.end(), [](const auto& a, const auto& b) { return a.tag < b.tag; });
  const std::string padded = strip + std::string(strip.size() % 2, '\0');
  return "II*\0"s + le(8 + padded.size(), 4) + padded + tiff_folder(tags, 8 + padded.size());
}

// EXIF that says how a picture lies.
inline std::string exif(unsigned orientation) {
  return "II*\0"s + le(8, 4) + tiff_folder({{274, 3, {orientation}}}, 8);
}

class PictureColours : public TestFolder {
 protected:
  fs::path file(const std::string& bytes) const {
    put(folder_ / "picture", bytes);
    return folder_ / "picture";
  }
  fs::path written(const std::string& name, OIIO::ImageSpec spec,
                   const std::vector<float>& values) const {
    const fs::path path = folder_ / name;
    const auto out = OIIO::ImageOutput::create(path.string());
    EXPECT_TRUE(out && out->open(path.string(), spec)) << OIIO::geterror();
    EXPECT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
    EXPECT_TRUE(out->close());
    return path;
  }
  static std::array<double, 3> first_pixel(const fs::path& path) {
    const FloatImage image = read_image(path).pixels;
    return {image.row(0)[0], image.row(0)[1], image.row(0)[2]};
  }
  static std::string refusal(const fs::path& path) {
    const std::string said = message_of([&] { read_image(path); });
    EXPECT_TRUE(said.empty() || said.starts_with(path.string())) << said;
    return said;
  }
  std::string refusal(const std::string& bytes) const { return refusal(file(bytes)); }
};

}  // namespace domefall
