#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/openimageio/picture_claims.h"

namespace domefall {
namespace {

constexpr unsigned kPhotometric = 262, kOrientation = 274, kBitsPerSample = 258,
                   kSamplesPerPixel = 277, kMaxSampleValue = 281, kTransferFunction = 301,
                   kWhitePoint = 318, kPrimaries = 319, kExtraSamples = 338, kSampleFormat = 339,
                   kIccProfile = 34675, kStoNits = 37439, kExifFolder = 34665,
                   kExifColourSpace = 40961, kInteroperability = 40965;

struct Tag {
  unsigned type = 0;
  std::uint64_t count = 0, at = 0;  // of its values
};

class TiffFolder {
 public:
  // `file` begins with the header of a TIFF.
  explicit TiffFolder(Stretch file) : file_(file) {
    const std::string order = file_.bytes(0, 2);
    if (order != "II" && order != "MM") refuse("its EXIF data are damaged");
    file_.big_endian = order == "MM";
    long_ = file_.number(2, 2) == 43;
    read(long_ ? file_.number(8, 8) : file_.number(4, 4));
  }
  // Another folder of the same file, to which a tag of this one points.
  std::optional<TiffFolder> below(unsigned tag) const {
    if (!tags_.contains(tag)) return std::nullopt;
    TiffFolder folder = *this;
    folder.tags_.clear();
    folder.read(static_cast<std::uint64_t>(value(tag, 0)));
    return folder;
  }

  bool has(unsigned tag) const { return tags_.contains(tag); }
  bool has_next() const { return next_ != 0; }
  std::uint64_t count(unsigned tag) const { return has(tag) ? tags_.at(tag).count : 0; }
  std::string text(unsigned tag) const {
    return has(tag) ? file_.bytes(tags_.at(tag).at, std::min<std::uint64_t>(count(tag), 64)) : "";
  }
  double value(unsigned tag, double otherwise, std::uint64_t k = 0) const {
    if (k >= count(tag)) return otherwise;
    const Tag& t = tags_.at(tag);
    const std::uint64_t at = t.at + k * size_of(t.type);
    constexpr unsigned kRational = 5, kFloat = 11, kDouble = 12;
    if (t.type == kRational)
      return static_cast<double>(file_.number(at, 4)) /
             static_cast<double>(file_.number(at + 4, 4));
    const std::uint64_t bits = file_.number(at, size_of(t.type));
    if (t.type == kFloat) return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (t.type == kDouble) return std::bit_cast<double>(bits);
    return static_cast<double>(bits);
  }

 private:
  static std::size_t size_of(unsigned type) {
    constexpr std::array<unsigned char, 19> kSizes{1, 1, 1, 2, 4, 8, 1, 1, 2, 4,
                                                   8, 4, 8, 4, 1, 1, 8, 8, 8};
    return type < kSizes.size() ? kSizes[type] : 1;
  }
  void read(std::uint64_t at) {
    const std::uint64_t word = long_ ? 8 : 4, entry = long_ ? 20 : 12;
    const std::uint64_t first = at + (long_ ? 8 : 2), count = file_.number(at, long_ ? 8 : 2);
    constexpr std::uint64_t kMostTags = 1 << 16;
    if (count > kMostTags) refuse("it has more than 65536 tags");
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::uint64_t place = first + k * entry;
      Tag tag{static_cast<unsigned>(file_.number(place + 2, 2)),
              file_.number(place + 4, static_cast<std::size_t>(word)), place + 4 + word};
      if (tag.count > word / size_of(tag.type))
        tag.at = file_.number(tag.at, static_cast<std::size_t>(word));
      tags_.emplace(static_cast<unsigned>(file_.number(place, 2)), tag);
    }
    next_ = file_.bytes(first + count * entry, word).size() < word
                ? 0
                : file_.number(first + count * entry, static_cast<std::size_t>(word));
  }

  Stretch file_;
  bool long_ = false;  // BigTIFF
  std::uint64_t next_ = 0;
  std::map<unsigned, Tag> tags_;
};

// Some cameras write 0 where they do not know.
void take_orientation(const TiffFolder& folder, PictureClaims& claims) {
  const double stated = folder.value(kOrientation, 1);
  if (stated < 0 || stated > 8) refuse(fmt::format("its orientation is {}, not 1 to 8", stated));
  claims.orientation = std::max(static_cast<int>(stated), 1);
}

// By DCF 2.0 a camera's "R03" and a colour space that is not calibrated mean Adobe RGB (1998).
bool is_adobe_rgb(const TiffFolder& exif) {
  constexpr double kNotCalibrated = 65535;
  if (exif.value(kExifColourSpace, 1) != kNotCalibrated) return false;
  const auto interoperability = exif.below(kInteroperability);
  return interoperability && interoperability->text(1).starts_with("R03");
}

void take_tiff_primaries(const TiffFolder& tiff, PictureClaims& claims) {
  if (!tiff.has(kWhitePoint) && !tiff.has(kPrimaries)) return;
  if (tiff.count(kPrimaries) == 0) {
    claims.notes.emplace_back("a WhitePoint without primaries is not used");
    return;
  }
  if (tiff.count(kPrimaries) != 6 || (tiff.has(kWhitePoint) && tiff.count(kWhitePoint) != 2))
    refuse("its PrimaryChromaticities or WhitePoint are damaged");
  auto& xy = claims.xy.emplace();
  for (std::size_t k = 0; k < 6; ++k) xy[k] = tiff.value(kPrimaries, 0, k);
  // TIFF 6.0 names no white where none is stated; that of sRGB is the usual one.
  xy[6] = tiff.value(kWhitePoint, 0.3127, 0), xy[7] = tiff.value(kWhitePoint, 0.329, 1);
  claims.xy_from = "PrimaryChromaticities";
}

// The colours of TIFF that OpenImageIO gives as RGB or grey, and the others' names.
void check_photometric(const TiffFolder& tiff, PictureClaims& claims) {
  enum { kWhiteIsZero, kBlackIsZero, kRgb, kPalette, kMask, kSeparated, kYcbcr };
  const int photometric = static_cast<int>(tiff.value(kPhotometric, kBlackIsZero));
  const auto is_bytes = tiff.value(kBitsPerSample, 1) == 8 && tiff.value(kSampleFormat, 1) == 1;
  if (photometric == kSeparated) refuse("its colours are inks (CMYK); convert it to RGB");
  if (photometric == kWhiteIsZero && !is_bytes)
    refuse("0 is white in it, which is read of 8 bits alone; convert it to one whose 0 is black");
  if (photometric == kPalette && tiff.value(kSamplesPerPixel, 1) != 1)
    refuse("it has a palette and further channels; convert it to RGB");
  // libtiff turns these itself, but does not exchange rows and columns.
  if (photometric == kYcbcr && claims.orientation != 1)
    refuse(
        fmt::format("it is stored as YCbCr with the orientation {}; turn it, or convert it to RGB",
                    claims.orientation));
  if (photometric < 0 || photometric == kMask || photometric > kYcbcr)
    refuse(
        fmt::format("its colours are of a kind (PhotometricInterpretation {}) that is not read; "
                    "convert it to RGB",
                    photometric));
  claims.colours = photometric <= kBlackIsZero ? 1 : 3;
}

}  // namespace

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

std::string Stretch::bytes(std::uint64_t at, std::uint64_t count) const {
  if (at >= size) return {};
  std::string out(static_cast<std::size_t>(std::min(count, size - at)), '\0');
  out.resize(read_at(file.descriptor(), path, begin + at, out.data(), out.size()));
  return out;
}

std::uint64_t Stretch::number(std::uint64_t at, std::size_t count) const {
  std::string digits = bytes(at, count);
  if (digits.size() < count) refuse("the file is cut short within what it says of itself");
  if (!big_endian) std::reverse(digits.begin(), digits.end());
  std::uint64_t value = 0;
  for (const char c : digits) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

Stretch Stretch::part(std::uint64_t at, std::uint64_t count) const {
  const std::uint64_t from = std::min(at, size);
  return {file, path, begin + from, std::min(count, size - from), big_endian};
}

void check_profile_size(std::uint64_t bytes) {
  constexpr std::uint64_t kLargest = 16 << 20;
  if (bytes > kLargest)
    refuse(fmt::format("its ICC profile has {} bytes; at most {} are read", bytes, kLargest));
}

void take_exif(const Stretch& stretch, PictureClaims& claims) {
  const TiffFolder folder(stretch);
  take_orientation(folder, claims);
  const auto exif = folder.below(kExifFolder);
  if (!exif || !is_adobe_rgb(*exif)) return;
  claims.gamma = 256 / 563.0;  // 2.19921875, as Adobe RGB (1998) 4.3.4.2 has it
  claims.xy = kAdobeRgbPlaces;
  claims.xy_from = "EXIF";
}

PictureClaims tiff_claims(const Stretch& file) {
  const TiffFolder tiff(file);
  PictureClaims claims;
  take_orientation(tiff, claims);
  check_photometric(tiff, claims);
  constexpr double kSigned = 2, kComplex = 5;
  const double format = tiff.value(kSampleFormat, 1);
  if (format == kSigned || format >= kComplex)
    refuse("its samples are signed integers or complex numbers, which are no light");
  // OpenImageIO makes black of other numbers.
  constexpr double kFloats = 3, kHalf = 16, kSingle = 32, kDouble = 64;
  const double stored = tiff.value(kBitsPerSample, 1);
  if (format == kFloats ? stored != kHalf && stored != kSingle && stored != kDouble
                        : stored > kHalf && stored != kSingle)
    refuse(fmt::format("its samples are {} of {} bits; convert it to floats of 16 or 32",
                       format == kFloats ? "floats" : "integers", stored));
  if (tiff.has(kTransferFunction))
    refuse("it has a TransferFunction of its own; convert it to sRGB or to linear floats");
  take_tiff_primaries(tiff, claims);
  claims.has_profile = tiff.has(kIccProfile);
  check_profile_size(tiff.count(kIccProfile));
  const int samples = static_cast<int>(tiff.value(kSamplesPerPixel, 1));
  const auto extra = static_cast<int>(tiff.count(kExtraSamples));
  for (int k = 0; k < std::min(extra, samples); ++k) {
    const double kind = tiff.value(kExtraSamples, 0, static_cast<std::uint64_t>(k));
    if (kind != 1 && kind != 2) continue;
    claims.alpha = kind == 1 ? Alpha::kAssociated : Alpha::kUnassociated;
    claims.alpha_channel = samples - extra + k;
    break;
  }
  if (tiff.has(kStoNits))
    claims.notes.push_back(
        fmt::format("its StoNits of {:g} is not used: what is white is said "
                    "by who shows it",
                    tiff.value(kStoNits, 0)));
  const double bits = tiff.value(kBitsPerSample, 1), most = tiff.value(kMaxSampleValue, 0);
  if (tiff.has(kMaxSampleValue) && format == 1 && most != std::exp2(bits) - 1)
    claims.notes.push_back(fmt::format("its MaxSampleValue of {:g} is not used: {:g} is white",
                                       most, std::exp2(bits) - 1));
  if (tiff.has_next()) claims.notes.emplace_back("the first of its pages");
  return claims;
}

}  // namespace domefall
