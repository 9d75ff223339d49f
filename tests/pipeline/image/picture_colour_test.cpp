// What files say of their pixels: colours, ICC profiles, alpha, and how pictures lie.
#include <gmock/gmock.h>
#include <lcms2.h>

#include <cmath>
#include <vector>

#include "pipeline/image/read_image.h"
#include "tests/pipeline/image/picture_bytes.h"

namespace domefall {
namespace {

using testing::HasSubstr;

constexpr std::array<double, 8> kAcesCg{0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767};

TEST_F(PictureColours, OfAPngAreWhatItsChunksSayInTheirOrder) {
  struct Case {
    std::string chunks;
    double light;
    std::array<double, 8> xy;
    const char* said;
  };
  const double power = std::pow(kHalf, 1 / 0.45455), rec709 = 0.2597;
  const Case cases[] = {
      {"", of_srgb(kHalf), kRec709Places, "sRGB (integers that say nothing else)"},
      {gama(100000), kHalf, kRec709Places, "linear (gAMA)"},
      {gama(45455), power, kRec709Places, "a power of 2.2 (gAMA)"},
      {gama(100000) + chrm(kP3D65Places), kHalf, kP3D65Places, "primaries P3-D65 (cHRM)"},
      {chrm(kRec2020Places), of_srgb(kHalf), kRec2020Places, "primaries Rec.2020 (cHRM)"},
      {kSrgbChunk + gama(100000) + chrm(kP3D65Places), of_srgb(kHalf), kRec709Places,
       "sRGB (its sRGB chunk)"},
      {iccp(linear_profile()), kHalf, kAcesCg, "ICC profile '"},
      {iccp(linear_profile()) + gama(45455), kHalf, kAcesCg, "ICC profile '"},
      {cicp(1, 8), kHalf, kRec709Places, "linear (cICP)"},
      {cicp(12, 13), of_srgb(kHalf), kP3D65Places, "primaries P3-D65 (cICP)"},
      {cicp(9, 8) + iccp(linear_profile()) + gama(45455), kHalf, kRec2020Places,
       "primaries Rec.2020 (cICP)"},
      {cicp(1, 1), rec709, kRec709Places, "Rec.709 (cICP)"},
      {cicp(1, 6), rec709, kRec709Places, "Rec.709 (cICP)"},
      {cicp(11, 4), std::pow(kHalf, 2.2), kDciP3Places, "a power of 2.2 (cICP)"},
      {cicp(1, 8) + kSrgbChunk, kHalf, kRec709Places, "linear (cICP)"},
  };
  for (const Case& c : cases) {
    const fs::path path = file(half_png(c.chunks));
    EXPECT_EQ(read_image(path).xy, c.xy) << c.said;
    EXPECT_THAT(picture_taken(path), HasSubstr(c.said));
    for (const double light : first_pixel(path)) EXPECT_NEAR(light, c.light, 2e-4) << c.said;
  }
  EXPECT_EQ(picture_taken(file(half_png(gama(100000)))),
            "4 x 2, linear (gAMA), primaries Rec.709 (none are stated)");
  // What stands after the pixels is no part of it.
  EXPECT_NEAR(first_pixel(file(half_png("", gama(100000))))[0], of_srgb(kHalf), 1e-5);
}

TEST_F(PictureColours, ThatCannotBeObeyedAreRefusedWithTheReason) {
  const std::pair<std::string, const char*> cases[] = {
      {cicp(9, 16), "cICP says that it is encoded for PQ displays"},
      {cicp(9, 18), "cICP says that it is encoded for HLG displays"},
      {cicp(1, 11), "cICP has the transfer function 11"},
      {cicp(2, 13), "cICP has the primaries 2"},
      {cicp(1, 13, 1), "codes are not full-range RGB (1/13/1/1)"},
      {cicp(1, 13, 0, 0), "codes are not full-range RGB (1/13/0/0)"},
      {chunk("cICP", "\1\15\0"s), "chunk cICP is damaged"},
      {chunk("gAMA", "\1"s), "chunk gAMA is damaged"},
      {chunk("cHRM", "\1"s), "chunk cHRM is damaged"},
      {chunk("sRGB", ""), "chunk sRGB is damaged"},
      {gama(0), "gAMA is 0"},
      {gama(0x7fffffff), "gAMA is 21474.8"},
      {chrm({0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3}), "primaries (cHRM) can be those of no"},
      {chrm({0, 0, 0, 0, 0, 0, 0, 0}), "primaries (cHRM) can be those of no picture"},
      {chrm({0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.9, 0.9}), "primaries (cHRM) can be those of no"},
      {iccp("no profile"), "ICC profile is damaged"},
      {chunk("iCCP", "x\0\0garbage"s), "ICC profile is damaged"},
      {iccp(std::string(100 << 20, '\0')), "ICC profile is damaged"},
  };
  for (const auto& [chunks, said] : cases)
    EXPECT_THAT(refusal(half_png(chunks)), HasSubstr(said)) << said;
  // The last length of a chunk that the file holds, and one that it does not.
  std::string cut = half_png("");
  cut.insert(33, be(0x7fffffff, 4) + "gAMA");
  EXPECT_THAT(refusal(cut), HasSubstr("the file is cut short within its chunk gAMA"));
}

TEST_F(PictureColours, OfIccProfilesAreHonoured) {
  // As two programs may say it: by three curves and a matrix, and by a table.
  const std::string tables = table_profile();
  const fs::path table = file(half_png(iccp(tables)));
  for (const double light : first_pixel(table)) EXPECT_NEAR(light, of_srgb(kHalf), 1e-3);
  // A red of Rec.709 is that of ACEScg that the program's own matrix gives.
  const std::string red =
      png(4, 2, 8, 2, "\xff\0\0\xff\0\0\xff\0\0\xff\0\0"s, iccp(linear_profile()));
  const auto pixel = first_pixel(file(red));
  EXPECT_NEAR(pixel[0], 0.6131, 2e-4);
  EXPECT_NEAR(pixel[1], 0.0702, 2e-4);
  EXPECT_NEAR(pixel[2], 0.0206, 2e-4);
  // A profile of grey, whose power is 2.
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 2);
  const std::string of_grey = saved(cmsCreateGrayProfile(cmsD50_xyY(), curve));
  cmsFreeToneCurve(curve);
  const fs::path single = file(png(4, 2, 8, 0, "\x80\x80\x80\x80"s, iccp(of_grey)));
  for (const double light : first_pixel(single)) EXPECT_NEAR(light, 0.25197, 2e-4);
  // White is white, of whatever white the profile is.
  const std::string white =
      png(4, 2, 8, 2, std::string(12, '\xff'), iccp(linear_profile(kDciP3Places)));
  for (const double light : first_pixel(file(white))) EXPECT_NEAR(light, 1, 2e-4);

  const std::vector<float> grey(4 * 2 * 3, 0.5f);
  for (const char* name : {"a.tif", "a.jpg"}) {
    OIIO::ImageSpec spec(4, 2, 3, OIIO::TypeDesc::UINT8);
    const std::string profile = linear_profile();
    spec.attribute("ICCProfile",
                   OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
    EXPECT_NEAR(first_pixel(written(name, spec, grey))[1], 0.5, 4e-3) << name;
  }
  // A WebP keeps it in a chunk of its own.
  std::string webp =
      contents(written("a.webp", OIIO::ImageSpec(4, 2, 3, OIIO::TypeDesc::UINT8), grey));
  const std::string profile = linear_profile();
  const std::string more = "VP8X" + le(10, 4) + "\x20\0\0\0"s + le(3, 3) + le(1, 3) + "ICCP" +
                           le(profile.size(), 4) + profile + std::string(profile.size() % 2, '\0');
  webp.insert(12, more);
  webp.replace(4, 4, le(webp.size() - 8, 4));
  EXPECT_NEAR(first_pixel(file(webp))[1], 0.5, 8e-3);
}

// A formula goes on beyond 1, and a table has nothing there.
TEST_F(PictureColours, BeyondTheTableOfAProfileAreRefused) {
  const auto bright = [this](const std::string& profile) {
    OIIO::ImageSpec spec(4, 2, 3, OIIO::TypeDesc::FLOAT);
    spec.attribute("ICCProfile",
                   OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                   profile.data());
    return written("bright.tif", spec, std::vector<float>(4 * 2 * 3, 4.0f));
  };
  EXPECT_NEAR(first_pixel(bright(linear_profile()))[1], 4, 1e-3);
  EXPECT_THAT(refusal(contents(bright(table_profile()))), HasSubstr("says only what 0 to 1 are"));
}

TEST_F(PictureColours, OfProfilesThatAreNoPicturesAreRefused) {
  const auto with = [](cmsProfileClassSignature kind, cmsColorSpaceSignature space) {
    const std::string profile = placeholder(kind, space);
    return tiff(1, 1, 3, 8, 2, "abc",
                {{34675, 1, std::vector<std::uint64_t>(profile.begin(), profile.end())}});
  };
  EXPECT_THAT(refusal(with(cmsSigOutputClass, cmsSigCmykData)),
              HasSubstr("its ICC profile is of CMYK colours"));
  EXPECT_THAT(refusal(with(cmsSigDisplayClass, cmsSigGrayData)),
              HasSubstr("its ICC profile is of grey, and its pixels have colours"));
  EXPECT_THAT(refusal(with(cmsSigNamedColorClass, cmsSigRgbData)),
              HasSubstr("its ICC profile is none of a picture's colours"));
  EXPECT_THAT(refusal(with(cmsSigLinkClass, cmsSigRgbData)),
              HasSubstr("its ICC profile is none of a picture's colours"));
  EXPECT_THAT(refusal(with(cmsSigInputClass, cmsSigRgbData)),
              HasSubstr("its ICC profile says no way from its colours to light"));
  std::string large = tiff(1, 1, 3, 8, 2, "abc", {{34675, 1, {0, 0, 0, 0, 0}}});
  const std::size_t tag = large.find(le(34675, 2) + le(1, 2));
  large.replace(tag + 4, 4, le(100 << 20, 4));
  EXPECT_THAT(refusal(large), HasSubstr("its ICC profile has 104857600 bytes; at most 16777216"));
}

TEST_F(PictureColours, UnderAlphaLieOverBlackInLinearLight) {
  // PNG: white, half transparent.
  std::string row;
  for (int k = 0; k < 4; ++k) row += be(0xffff, 2) + be(0xffff, 2) + be(0xffff, 2) + be(0x8000, 2);
  const fs::path clear = file(png(4, 2, 16, 6, row, ""));
  EXPECT_NEAR(first_pixel(clear)[0], kHalf, 1e-6);
  EXPECT_THAT(picture_taken(clear), HasSubstr("transparent in parts, over black"));
  std::string opaque;
  for (int k = 0; k < 4; ++k) opaque += "\x80\xff"s;
  const fs::path grey = file(png(4, 2, 8, 4, opaque, ""));
  EXPECT_NEAR(first_pixel(grey)[2], of_srgb(128 / 255.0), 1e-6);
  EXPECT_THAT(picture_taken(grey), Not(HasSubstr("transparent")));
  // A palette of white and clear red.
  const fs::path palette = file(png(
      4, 2, 8, 3, "\1\1\0\0"s, chunk("PLTE", "\xff\xff\xff\xff\0\0"s) + chunk("tRNS", "\xff\0"s)));
  EXPECT_EQ(first_pixel(palette), (std::array{0.0, 0.0, 0.0}));
  EXPECT_EQ(read_image(palette).pixels.row(0)[6], 1.0f);

  // TIFF: the fourth sample is light that is there, light that is yet to be dimmed, or neither.
  const std::string strip = "\xff\x80\x40\x80"s;
  const auto rgba = [&](const std::vector<TiffTag>& more) {
    return file(tiff(1, 1, 4, 8, 2, strip, more));
  };
  const double half = 128 / 255.0;
  EXPECT_NEAR(first_pixel(rgba({{338, 3, {1}}}))[1], of_srgb(half), 1e-6);
  EXPECT_NEAR(first_pixel(rgba({{338, 3, {2}}}))[1], of_srgb(half) * half, 1e-6);
  EXPECT_NEAR(first_pixel(rgba({{338, 3, {2}}}))[0], half, 1e-6);
  EXPECT_NEAR(first_pixel(rgba({{338, 3, {0}}}))[0], 1, 1e-6);
  EXPECT_THAT(picture_taken(rgba({{338, 3, {0}}})), HasSubstr("1 more channel not used"));
  EXPECT_THAT(picture_taken(rgba({})), HasSubstr("1 more channel not used"));
  // Grey with two more samples is no RGB.
  EXPECT_NEAR(first_pixel(file(tiff(1, 1, 3, 8, 1, "\xff\x80\x80", {{338, 3, {0, 2}}})))[1], half,
              1e-6);

  OIIO::ImageSpec spec(4, 2, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", "lossless");
  const std::vector<float> white(4 * 2 * 4, 1);
  std::vector<float> half_white = white;
  for (std::size_t k = 0; k < half_white.size(); ++k) half_white[k] = 0.5f;
  EXPECT_NEAR(first_pixel(written("a.webp", spec, white))[0], 1, 1e-6);
  EXPECT_THAT(refusal(written("a.webp", spec, half_white)),
              HasSubstr("transparent in parts, which is not read of WebP"));
}

TEST_F(PictureColours, AreThoseThatTheUserAsksFor) {
  const fs::path path = file(half_png(gama(100000) + chrm(kP3D65Places)));
  const LightImage srgb = read_light_image(path, PixelEncoding::kSrgb);
  EXPECT_NEAR(srgb.pixels.pixels[0], of_srgb(kHalf), 1e-3);
  EXPECT_EQ(srgb.xy, kP3D65Places);
  EXPECT_THAT(srgb.taken, HasSubstr("sRGB (as asked for)"));
  const LightImage linear =
      read_light_image(file(half_png(iccp(table_profile()))), PixelEncoding::kLinear);
  EXPECT_NEAR(linear.pixels.pixels[0], kHalf, 1e-3);
  EXPECT_THAT(linear.taken, HasSubstr("its ICC profile is not used"));
}

class PictureKinds : public PictureColours {};

// As cameras say that they were set to Adobe RGB (DCF 2.0).
TEST_F(PictureKinds, OfCamerasMayBeAdobeRgb) {
  const std::string head = "II*\0"s + le(8, 4);
  const std::string first = tiff_folder({{34665, 4, {26}}}, 8);
  const std::string second = tiff_folder({{40961, 3, {65535}}, {40965, 4, {56}}}, 26);
  const std::string third = tiff_folder({{1, 2, {'R', '0', '3', 0}}}, 56);
  const std::string block = head + first + second + third;
  const std::vector<float> grey(64 * 32 * 3, 0.5f);
  std::string bytes =
      contents(written("a.jpg", OIIO::ImageSpec(64, 32, 3, OIIO::TypeDesc::UINT8), grey));
  bytes.insert(2, "\xff\xe1" + be(8 + block.size(), 2) + "Exif\0\0"s + block);
  EXPECT_EQ(picture_taken(file(bytes)),
            "64 x 32, a power of 2.199 (EXIF), primaries Adobe RGB (EXIF)");
  EXPECT_NEAR(first_pixel(file(bytes))[0], std::pow(128 / 255.0, 563 / 256.0), 1e-3);
}

// Each gives 123 over 456.
TEST_F(PictureKinds, LieAsTheirOrientationSays) {
  constexpr std::array kStored{"123456", "321654", "654321", "456123",
                               "142536", "362514", "635241", "415263"};
  for (unsigned orientation = 1; orientation <= 8; ++orientation) {
    const bool lies = orientation > 4;
    std::string strip;
    for (const char* c = kStored[orientation - 1]; *c; ++c) strip += static_cast<char>(*c - '0');
    const unsigned w = lies ? 2 : 3, h = lies ? 3 : 2;
    const auto looks_right = [&](const fs::path& path) {
      const LightImage image = read_light_image(path, PixelEncoding::kLinear);
      ASSERT_EQ(image.pixels.width, 3) << orientation;
      ASSERT_EQ(image.pixels.height, 2) << orientation;
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(image.pixels.pixels[static_cast<std::size_t>(3 * k)] * 255.0, k + 1, 2e-3)
            << orientation;
    };
    looks_right(file(tiff(w, h, 1, 8, 1, strip, {{274, 3, {orientation}}})));
    // The same in a PNG, whose EXIF may come before its pixels or after them.
    std::string rows;
    for (unsigned y = 0; y < h; ++y) rows += '\0' + strip.substr(y * w, w);
    const std::string head =
        "\x89PNG\r\n\x1a\n" + chunk("IHDR", be(w, 4) + be(h, 4) + "\10\0\0\0\0"s);
    const std::string pixels = chunk("IDAT", deflated(rows)), end = chunk("IEND", "");
    looks_right(file(head + chunk("eXIf", exif(orientation)) + pixels + end));
    looks_right(file(head + pixels + chunk("eXIf", exif(orientation)) + end));
  }
  EXPECT_THAT(picture_taken(file(tiff(2, 3, 1, 8, 1, "abcdef", {{274, 3, {6}}}))),
              HasSubstr("3 x 2, turned upright (orientation 6)"));
  EXPECT_EQ(refusal(tiff(2, 3, 1, 8, 1, "abcdef", {{274, 3, {0}}})), "");
  EXPECT_THAT(refusal(tiff(2, 3, 1, 8, 1, "abcdef", {{274, 3, {9}}})),
              HasSubstr("its orientation is 9, not 1 to 8"));
  EXPECT_THAT(refusal(half_png(chunk("eXIf", "nothing"))), HasSubstr("its EXIF data are damaged"));
  EXPECT_THAT(refusal(half_png(chunk("eXIf", "II*\0\xff\xff\xff\0"s))), HasSubstr("cut short"));
}

TEST_F(PictureKinds, OfCamerasLieAsTheirExifSays) {
  // The left half is white; orientation 6 makes it the upper.
  std::vector<float> values;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) values.insert(values.end(), 3, x < 32 ? 1.0f : 0.0f);
  for (const char* name : {"a.jpg", "a.webp"}) {
    OIIO::ImageSpec spec(64, 32, 3, OIIO::TypeDesc::UINT8);
    fs::path path = written(name, spec, values);
    std::string bytes = contents(path);
    const std::string block = exif(6);
    if (name == "a.jpg"s) {
      bytes.insert(2, "\xff\xe1" + be(8 + block.size(), 2) + "Exif\0\0"s + block);
    } else {
      bytes.insert(12, "VP8X" + le(10, 4) + "\x08\0\0\0"s + le(63, 3) + le(31, 3));
      bytes += std::string(bytes.size() % 2, '\0') + "EXIF" + le(block.size(), 4) + block +
               std::string(block.size() % 2, '\0');
      bytes.replace(4, 4, le(bytes.size() - 8, 4));
    }
    const FloatImage image = read_image(file(bytes)).pixels;
    ASSERT_EQ(image.width, 32) << name;
    ASSERT_EQ(image.height, 64) << name;
    EXPECT_GT(image.row(2)[3 * 16], 0.9) << name;
    EXPECT_LT(image.row(61)[3 * 16], 0.1) << name;
  }
}

TEST_F(PictureKinds, OfTiffAreReadRightOrNotAtAll) {
  const auto first = [this](const std::string& bytes) { return first_pixel(file(bytes))[0]; };
  // 0 is white.
  EXPECT_NEAR(first(tiff(1, 1, 1, 8, 0, "\0"s)), 1, 1e-6);
  EXPECT_NEAR(first(tiff(1, 1, 1, 8, 0, "\xff")), 0, 1e-6);
  EXPECT_THAT(refusal(tiff(1, 1, 1, 16, 0, "ab")), HasSubstr("0 is white in it"));
  EXPECT_THAT(refusal(tiff(1, 1, 1, 1, 0, "a")), HasSubstr("0 is white in it"));
  // 12 bits of 16: all of them are white.
  EXPECT_NEAR(first(tiff(2, 1, 1, 12, 1, "\xff\xf8\0"s)), 1, 1e-6);
  EXPECT_NEAR(first(tiff(8, 1, 1, 1, 1, "\x80")), 1, 1e-6);
  EXPECT_THAT(picture_taken(file(tiff(1, 1, 1, 16, 1, "ab", {{281, 3, {4095}}}))),
              HasSubstr("its MaxSampleValue of 4095 is not used: 65535 is white"));
  // A palette of 4 bits, whose second colour is red.
  std::vector<std::uint64_t> map(48, 0);
  map[1] = 65535;
  EXPECT_EQ(first_pixel(file(tiff(2, 1, 1, 4, 3, "\x10", {{320, 3, map}}))),
            (std::array{1.0, 0.0, 0.0}));
  EXPECT_THAT(refusal(tiff(1, 1, 4, 8, 5, "abcd")), HasSubstr("its colours are inks (CMYK)"));
  EXPECT_THAT(refusal(tiff(1, 1, 3, 8, 8, "abc")), HasSubstr("PhotometricInterpretation 8"));
  EXPECT_THAT(refusal(tiff(1, 1, 3, 8, 2, "abc", {{339, 3, {2, 2, 2}}})),
              HasSubstr("signed integers"));
  // Of 24 bits OpenImageIO makes black.
  EXPECT_THAT(refusal(tiff(1, 1, 1, 24, 1, "abc", {{339, 3, {3}}})),
              HasSubstr("floats of 24 bits"));
  EXPECT_THAT(refusal(tiff(1, 1, 1, 24, 1, "abc")), HasSubstr("integers of 24 bits"));
  EXPECT_THAT(refusal(tiff(1, 1, 3, 8, 2, "abc", {{301, 3, {1, 2, 3, 4}}})),
              HasSubstr("a TransferFunction of its own"));

  const TiffTag white{318, 5, {312700, 329000}},
      primaries{319, 5, {680000, 320000, 265000, 690000, 150000, 60000}};
  const fs::path p3 = file(tiff(1, 1, 3, 8, 2, "abc", {white, primaries}));
  EXPECT_EQ(read_image(p3).xy, kP3D65Places);
  EXPECT_THAT(picture_taken(p3), HasSubstr("primaries P3-D65 (PrimaryChromaticities)"));
  EXPECT_THAT(refusal(tiff(1, 1, 3, 8, 2, "abc", {{319, 5, {0, 0, 0, 0, 0, 0}}})),
              HasSubstr("can be those of no picture"));
}

// A frame header (SOF) of four components.
TEST_F(PictureKinds, OfInksInAJpegAreRefused) {
  EXPECT_THAT(refusal("\xff\xd8\xff\xc0"s + be(20, 2) + "\x08" + be(8, 2) + be(16, 2) +
                      "\4\1\x11\0\2\x11\0\3\x11\0\4\x11\0"s + std::string(200, '\0')),
              HasSubstr("its colours are inks (CMYK)"));
}

// A pixel of 2^8, in Radiance's four bytes: mantissas of 128 and an exponent of 137.
TEST_F(PictureKinds, OfRadianceAreTheLightThatWasMeasured) {
  const auto radiance = [](const std::string& header, const std::string& size = "-Y 1 +X 2",
                           const std::string& format = "32-bit_rle_rgbe") {
    return "#?RADIANCE\n" + header + "FORMAT=" + format + "\n\n" + size +
           "\n\x80\x40\x20\x89\x80\x80\x80\x88";
  };
  EXPECT_NEAR(first_pixel(file(radiance("")))[0], 256, 2);
  const double plain = first_pixel(file(radiance("")))[0];
  EXPECT_DOUBLE_EQ(first_pixel(file(radiance("EXPOSURE=2\nEXPOSURE= 2.0\n")))[0], plain / 4);
  EXPECT_DOUBLE_EQ(first_pixel(file(radiance("COLORCORR=0.5 1 1\n")))[0], plain * 2);
  const fs::path path = file(radiance("PRIMARIES=0.68 0.32 0.265 0.69 0.15 0.06 0.3127 0.329\n"));
  EXPECT_EQ(read_image(path).xy, kP3D65Places);
  // The second pixel comes first.
  EXPECT_NEAR(first_pixel(file(radiance("", "-Y 1 -X 2")))[0], plain / 2, 1);
  EXPECT_THAT(refusal(radiance("EXPOSURE=0\n")), HasSubstr("EXPOSURE and COLORCORR must be"));
  EXPECT_THAT(refusal(radiance("EXPOSURE=nan\n")), HasSubstr("its EXPOSURE is not 1 number"));
  EXPECT_THAT(refusal(radiance("PRIMARIES=1 2\n")), HasSubstr("its PRIMARIES is not 8 numbers"));
  EXPECT_THAT(refusal(radiance("GAMMA=2.2\n")), HasSubstr("encoded by a GAMMA"));
  EXPECT_THAT(refusal(radiance("", "-Y 1 +X 2", "32-bit_rle_xyze")), HasSubstr("are XYZ"));
  EXPECT_THAT(refusal(radiance("", "+X 2 -Y 1")), HasSubstr("columns are stored as rows"));
}

}  // namespace
}  // namespace domefall
