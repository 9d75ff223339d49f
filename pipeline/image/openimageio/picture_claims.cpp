#include "pipeline/image/openimageio/picture_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/openimageio/exr_layers.h"

namespace domefall {
namespace {

using namespace std::literals;

// A file may have so many parts (chunks, segments, tags) before all of them have been looked at.
// The largest pictures have 1e5 of them.
constexpr int kMostParts = 1 << 20;
constexpr std::uint64_t kLargestHeader = 1 << 16;  // of Radiance, which is lines of text

// ---- PNG, third edition ----

std::array<double, 8> png_chromaticities(const Stretch& data) {
  std::array<double, 8> xy{};
  // White comes first there.
  for (std::size_t k = 0; k < 8; ++k)
    xy[(k + 6) % 8] = static_cast<double>(data.number(4 * k, 4)) / 1e5;
  return xy;
}

void take_png_chunk(const std::string& name, const Stretch& data, PictureClaims& claims) {
  const auto require = [&](std::uint64_t bytes) {
    if (data.size != bytes) refuse(fmt::format("its chunk {} is damaged", name));
  };
  if (name == "cICP") {
    require(4);
    const auto code = [&](std::uint64_t k) { return static_cast<int>(data.number(k, 1)); };
    claims.code_points = CodePoints{code(0), code(1), code(2), code(3)};
  } else if (name == "iCCP") {
    check_profile_size(data.size);
    claims.has_profile = true;
  } else if (name == "sRGB") {
    require(1);
    claims.srgb = true;
  } else if (name == "gAMA") {
    require(4);
    claims.gamma = static_cast<double>(data.number(0, 4)) / 1e5;
  } else if (name == "cHRM") {
    require(32);
    claims.xy = png_chromaticities(data), claims.xy_from = "cHRM";
  } else if (name == "acTL") {
    claims.notes.emplace_back("the still picture of an animation");
  }
}

// Colours are stated before the pixels, and EXIF before or after them.
PictureClaims png_claims(const Stretch& file) {
  PictureClaims claims, of_exif;
  bool pixels = false;
  std::uint64_t at = 8;
  for (int k = 0; at + 12 <= file.size; ++k) {
    if (k == kMostParts) refuse("it has more than a million chunks");
    const std::uint64_t length = file.number(at, 4);
    const std::string name = file.bytes(at + 4, 4);
    if (length > file.size - at - 12 && name != "IDAT")
      refuse(fmt::format("the file is cut short within its chunk {}", name));
    const Stretch data = file.part(at + 8, length);
    if (name == "IEND") break;
    pixels |= name == "IDAT";
    if (name == "eXIf") take_exif(data, of_exif);
    if (!pixels) take_png_chunk(name, data, claims);
    at += 12 + length;
  }
  claims.orientation = of_exif.orientation;
  return claims;
}

// ---- JPEG, ITU-T T.81 ----

PictureClaims jpeg_claims(const Stretch& file) {
  PictureClaims claims;
  std::uint64_t at = 2, profile = 0;
  bool has_exif = false;
  for (int k = 0; at + 4 <= file.size; ++k) {
    if (k == kMostParts) refuse("it has more than a million segments");
    const std::string start = file.bytes(at, 4);
    const auto marker = static_cast<unsigned char>(start[1]);
    if (start[0] != '\xff' || marker == 0xff) {  // libjpeg passes over what belongs to no segment
      ++at;
      continue;
    }
    if (marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) {  // without a length
      at += 2;
      continue;
    }
    if (marker == 0xd9 || marker == 0xda) break;
    const std::uint64_t length = file.number(at + 2, 2);
    const Stretch data = file.part(at + 4, length - std::min<std::uint64_t>(length, 2));
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc &&
        data.number(5, 1) > 3)
      refuse("its colours are inks (CMYK); convert it to RGB");
    if (marker == 0xe1 && !has_exif && data.bytes(0, 6) == "Exif\0\0"s) {
      take_exif(data.part(6, data.size), claims);
      has_exif = true;  // the first is the picture's
    }
    if (marker == 0xe2 && data.bytes(0, 12) == "ICC_PROFILE\0"s)
      claims.has_profile = true, check_profile_size(profile += data.size);
    at += 2 + std::max<std::uint64_t>(length, 2);
  }
  return claims;
}

// ---- WebP, RFC 9649 ----

PictureClaims webp_claims(Stretch file) {
  constexpr std::uint64_t kFirst = 12, kHead = 8;
  file.big_endian = false;
  PictureClaims claims;
  std::uint64_t at = kFirst;
  for (int k = 0; at + kHead <= file.size; ++k) {
    if (k == kMostParts) refuse("it has more than a million chunks");
    const std::string name = file.bytes(at, 4);
    const std::uint64_t length = file.number(at + 4, 4);
    const Stretch data = file.part(at + kHead, length);
    constexpr std::uint64_t kAnimation = 2;
    if (name == "VP8X" && (data.number(0, 1) & kAnimation))
      refuse("it is an animation; save one picture of it");
    if (name == "ICCP") {
      check_profile_size(length);
      claims.has_profile = true;
      claims.profile = data.bytes(0, data.size);
    }
    // Some programs leave the mark of a JPEG's EXIF before it.
    if (name == "EXIF")
      take_exif(data.bytes(0, 6) == "Exif\0\0"s ? data.part(6, data.size) : data, claims);
    at += kHead + length + length % 2;
  }
  return claims;
}

// ---- Radiance ----

// Takes as many numbers as `values` has, whatever the locale.
template <std::size_t kCount>
std::array<double, kCount> header_numbers(std::string_view line, std::string_view name) {
  std::array<double, kCount> values{};
  for (double& value : values) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      refuse(fmt::format("its {} is not {} number{}", name, kCount, kCount == 1 ? "" : "s"));
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
  return values;
}

// Values have been multiplied by what EXPOSURE and COLORCORR say, each time that one of them
// appears (Radiance's file formats, "Picture file header").
void take_radiance_line(std::string_view line, PictureClaims& claims) {
  const auto value_of = [line](std::string_view name) -> std::optional<std::string_view> {
    if (line.starts_with(name) && line.substr(name.size()).starts_with('='))
      return line.substr(name.size() + 1);
    return std::nullopt;
  };
  if (const auto format = value_of("FORMAT"); format && !format->starts_with("32-bit_rle_rgbe"))
    refuse("its colours are XYZ; convert it to RGB");
  if (const auto gamma = value_of("GAMMA"); gamma && header_numbers<1>(*gamma, "GAMMA")[0] != 1)
    refuse("its values are encoded by a GAMMA; convert it to linear ones");
  std::array<double, 3> by{1, 1, 1};
  if (const auto exposure = value_of("EXPOSURE"))
    by.fill(header_numbers<1>(*exposure, "EXPOSURE")[0]);
  if (const auto correction = value_of("COLORCORR"))
    by = header_numbers<3>(*correction, "COLORCORR");
  for (std::size_t c = 0; c < 3; ++c) {
    claims.scale[c] /= by[c];
    if (!(claims.scale[c] > 1e-12 && claims.scale[c] < 1e12))
      refuse("its EXPOSURE and COLORCORR must be positive, and be within 1e-12 and 1e12 together");
  }
  if (const auto primaries = value_of("PRIMARIES"))
    claims.xy = header_numbers<8>(*primaries, "PRIMARIES"), claims.xy_from = "PRIMARIES";
}

PictureClaims radiance_claims(const Stretch& file) {
  const std::string header = file.bytes(0, kLargestHeader);
  PictureClaims claims;
  std::string_view rest = header;
  for (;;) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) refuse("its header has no end");
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (line.empty()) break;
    take_radiance_line(line, claims);
  }
  const std::string_view size = rest.substr(0, rest.find('\n'));
  const bool mirrored = size.find("-X") != std::string_view::npos;
  if (size.starts_with("-Y"))
    claims.orientation = mirrored ? 2 : 1;
  else if (size.starts_with("+Y"))
    claims.orientation = mirrored ? 3 : 4;
  else
    refuse("its columns are stored as rows; turn it");
  return claims;
}

// ---- OpenEXR ----

// OpenEXR's attribute colorInteropID names a space of the Color Interop Forum.  Chromaticities
// count before it.
void take_interop_id(const std::string& id, PictureClaims& claims) {
  if (id.empty() || id == "unknown") return;
  static const std::map<std::string, std::array<double, 8>> kLinear{
      {"lin_rec709_scene", kRec709Places},
      {"lin_rec2020_scene", kRec2020Places},
      {"lin_p3d65_scene", kP3D65Places},
      {"lin_adobergb_scene", kAdobeRgbPlaces},
      {"lin_ap1_scene", kAp1Places},
      {"lin_ap0_scene", kAp0Places},
      {"lin_ciexyzd65_scene", {1, 0, 0, 1, 0, 0, 0.3127, 0.329}}};
  if (id == "data") refuse("it says that it is data and no colours (colorInteropID)");
  const auto found = kLinear.find(id);
  if (found == kLinear.end())
    refuse(fmt::format("its colorInteropID '{}' is not known here; convert it to linear light",
                       short_name(id)));
  if (!claims.xy) claims.xy = found->second, claims.xy_from = "colorInteropID";
}

}  // namespace

PictureClaims picture_claims(std::string_view format, const RegularFile& file,
                             const std::filesystem::path& path) {
  const Stretch whole{file, path, 0, file.size()};
  if (format == "png") return png_claims(whole);
  if (format == "tiff") return tiff_claims(whole);
  if (format == "jpeg") return jpeg_claims(whole);
  if (format == "webp") return webp_claims(whole);
  if (format == "hdr") return radiance_claims(whole);
  return {};
}

PictureClaims exr_claims(const OIIO::ImageSpec& spec) {
  PictureClaims claims;
  claims.alpha = Alpha::kAssociated;
  claims.orientation = spec.get_int_attribute("Orientation", 1);
  if (claims.orientation < 1 || claims.orientation > 8)
    refuse(fmt::format("its orientation is {}, not 1 to 8", claims.orientation));
  if (spec.get_string_attribute("textureformat") == "CubeFace Environment")
    refuse("it is a map on the faces of a cube (envmap); convert it to latitude and longitude");
  std::array<float, 8> stated{};
  if (spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                        stated.data())) {
    std::copy(stated.begin(), stated.end(), claims.xy.emplace().begin());
    claims.xy_from = "chromaticities";
  }
  take_interop_id(std::string(spec.get_string_attribute("colorInteropID")), claims);
  std::array<float, 2> neutral{};
  if (spec.getattribute("adoptedNeutral",
                        OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC2),
                        neutral.data()) &&
      !(claims.xy && std::abs((*claims.xy)[6] - neutral[0]) < 1e-4 &&
        std::abs((*claims.xy)[7] - neutral[1]) < 1e-4))
    claims.notes.push_back(
        fmt::format("its adoptedNeutral {:.4g}, {:.4g} is not used", neutral[0], neutral[1]));
  if (const float white = spec.get_float_attribute("whiteLuminance", 0); white != 0)
    claims.notes.push_back(fmt::format(
        "its whiteLuminance of {:g} cd/m^2 is not used: what is white is said by who shows it",
        white));
  return claims;
}

}  // namespace domefall
