#include "pipeline/image/openimageio/picture_colour.h"

#include <fmt/format.h>
#include <lcms2.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/openimageio/exr_layers.h"
#include "pipeline/image/openimageio/picture_claims.h"

namespace domefall {
namespace {

using Places = std::array<double, 8>;

struct NamedPrimaries {
  const char* name;
  Places xy;
};

constexpr Places kRec601Places{0.63, 0.34, 0.31, 0.595, 0.155, 0.07, 0.3127, 0.329},
    kPalPlaces{0.64, 0.33, 0.29, 0.6, 0.15, 0.06, 0.3127, 0.329};
constexpr std::array<NamedPrimaries, 10> kNamedPrimaries{
    {{"Rec.709", kRec709Places},
     {"Rec.2020", kRec2020Places},
     {"DCI-P3", kDciP3Places},
     {"P3-D65", kP3D65Places},
     {"ACEScg", kAp1Places},
     {"ACES2065-1", kAp0Places},
     {"Adobe RGB", kAdobeRgbPlaces},
     {"Rec.601 of 525 lines", kRec601Places},
     {"Rec.601 of 625 lines", kPalPlaces},
     {"CIE XYZ", {1, 0, 0, 1, 0, 0, 1 / 3.0, 1 / 3.0}}}};

// The code points of H.273 whose primaries and whites are obeyed.
constexpr std::array<std::pair<int, Places>, 7> kCodedPrimaries{{{1, kRec709Places},
                                                                 {5, kPalPlaces},
                                                                 {6, kRec601Places},
                                                                 {7, kRec601Places},
                                                                 {9, kRec2020Places},
                                                                 {11, kDciP3Places},
                                                                 {12, kP3D65Places}}};

// Returns the known primaries that a file means with its rounded digits, or nothing.
const NamedPrimaries* known_primaries(const Places& xy) {
  constexpr double kRounding = 5e-5;
  for (const NamedPrimaries& known : kNamedPrimaries)
    if (std::equal(xy.begin(), xy.end(), known.xy.begin(),
                   [](double a, double b) { return std::abs(a - b) <= kRounding; }))
      return &known;
  return nullptr;
}

// Primaries must be finite, and make a triangle with the white in it, so that they can be mixed to
// it.  Those of ACES2065-1 go beyond the real colours.
void check_primaries(const Places& xy, const std::string& from) {
  constexpr double kFarthest = 2, kLeastArea = 1e-3, kLeastWhite = 0.01;
  const auto area = [&xy](std::size_t a, std::size_t b, std::size_t c) {
    const double ux = xy[2 * b] - xy[2 * a], uy = xy[2 * b + 1] - xy[2 * a + 1],
                 vx = xy[2 * c] - xy[2 * a], vy = xy[2 * c + 1] - xy[2 * a + 1];
    return ux * vy - uy * vx;
  };
  const bool near = std::ranges::all_of(xy, [](double v) { return std::abs(v) <= kFarthest; });
  const double whole = near ? area(0, 1, 2) : 0;
  const auto part = [&](std::size_t a, std::size_t b) { return area(a, b, 3) / whole; };
  if (std::abs(whole) < kLeastArea || xy[7] < kLeastWhite || part(0, 1) < kLeastArea ||
      part(1, 2) < kLeastArea || part(2, 0) < kLeastArea)
    refuse(fmt::format(
        "its primaries ({}) can be those of no picture: red {:g}, {:g}, green {:g}, {:g}, "
        "blue {:g}, {:g}, white {:g}, {:g}",
        from, xy[0], xy[1], xy[2], xy[3], xy[4], xy[5], xy[6], xy[7]));
}

using Profile = std::unique_ptr<void, int (*)(void*)>;

Profile linear_acescg() {
  const cmsCIExyY white{kAp1Places[6], kAp1Places[7], 1};
  const cmsCIExyYTRIPLE primaries{{kAp1Places[0], kAp1Places[1], 1},
                                  {kAp1Places[2], kAp1Places[3], 1},
                                  {kAp1Places[4], kAp1Places[5], 1}};
  const std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)> line(cmsBuildGamma(nullptr, 1),
                                                                    cmsFreeToneCurve);
  cmsToneCurve* lines[] = {line.get(), line.get(), line.get()};
  return {cmsCreateRGBProfile(&white, &primaries, lines), cmsCloseProfile};
}

std::string profile_name(void* profile) {
  std::array<char, 256> name{};
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", name.data(), name.size() - 1);
  return short_name(name.data());
}

std::string space_name(cmsColorSpaceSignature space) {
  const auto bits = static_cast<std::uint32_t>(space);
  std::string name;
  for (int shift = 24; shift >= 0; shift -= 8) name += static_cast<char>(bits >> shift & 0xff);
  return short_name(name);
}

// Says whether a profile has formulas for its curves, which also hold beyond 0 and 1, and no
// tables.
bool has_endless_curves(cmsHPROFILE profile) {
  const bool grey = cmsGetColorSpace(profile) == cmsSigGrayData;
  if (!grey && !cmsIsMatrixShaper(profile)) return false;
  const auto is_formula = [&](cmsTagSignature tag) {
    const auto* curve = static_cast<const cmsToneCurve*>(cmsReadTag(profile, tag));
    return curve != nullptr && cmsGetToneCurveParametricType(curve) != 0;
  };
  if (grey) return is_formula(cmsSigGrayTRCTag);
  return is_formula(cmsSigRedTRCTag) && is_formula(cmsSigGreenTRCTag) &&
         is_formula(cmsSigBlueTRCTag);
}

}  // namespace

PictureColour::PictureColour(const PictureClaims& claims, const std::string& profile,
                             PixelEncoding encoding, bool is_floating, int colours)
    : colours_(colours), xy_(kRec709Places), alpha_(claims.alpha) {
  std::copy(claims.scale.begin(), claims.scale.end(), scale_.begin());
  const bool of_file = encoding == PixelEncoding::kOfFile;
  if (of_file && claims.code_points) {
    take_code_points(*claims.code_points);
    return;
  }
  if (of_file && claims.has_profile) {
    take_profile(profile);
    return;
  }
  take_curve(claims, encoding, is_floating);
  take_primaries(claims);
  if (!is_unscaled())
    words_.push_back(fmt::format("values times {:.6g}, {:.6g}, {:.6g} (EXPOSURE, COLORCORR)",
                                 scale_[0], scale_[1], scale_[2]));
  if (claims.has_profile) words_.emplace_back("its ICC profile is not used");
  if (claims.code_points) words_.emplace_back("its cICP is not used");
}

void PictureColour::take_code_points(const CodePoints& code) {
  const auto* primaries = std::ranges::find_if(
      kCodedPrimaries, [&](const auto& p) { return p.first == code.primaries; });
  if (code.matrix != 0 || code.full_range != 1)
    refuse(fmt::format("its cICP says that its codes are not full-range RGB ({}/{}/{}/{})",
                       code.primaries, code.transfer, code.matrix, code.full_range));
  if (primaries == kCodedPrimaries.end())
    refuse(
        fmt::format("its cICP has the primaries {}, which are not known here; 1, 5, 6, "
                    "7, 9, 11 and 12 are",
                    code.primaries));
  switch (code.transfer) {
    case 1:
    case 6:
    case 14:
    case 15:
      curve_ = Curve::kRec709;
      break;
    case 4:
      curve_ = Curve::kPower, exponent_ = 2.2f;
      break;
    case 5:
      curve_ = Curve::kPower, exponent_ = 2.8f;
      break;
    case 8:
      curve_ = Curve::kLinear;
      break;
    case 13:
      curve_ = Curve::kSrgb;
      break;
    case 16:
    case 18:
      refuse(fmt::format(
          "its cICP says that it is encoded for {} displays; convert it to linear OpenEXR",
          code.transfer == 16 ? "PQ" : "HLG"));
    default:
      refuse(
          fmt::format("its cICP has the transfer function {}, which is not known here; "
                      "1, 4, 5, 6, 8, 13, 14 and 15 are",
                      code.transfer));
  }
  constexpr std::array kNames{"linear", "sRGB", "a power of", "Rec.709"};
  std::string curve = kNames[static_cast<std::size_t>(curve_)];
  if (curve_ == Curve::kPower) curve += fmt::format(" {:g}", exponent_);
  words_.push_back(curve + " (cICP)");
  xy_ = primaries->second;
  words_.push_back(fmt::format("primaries {} (cICP)", known_primaries(xy_)->name));
}

void PictureColour::take_profile(const std::string& bytes) {
  const Profile from(
      cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())),
      cmsCloseProfile);
  if (bytes.empty() || !from) refuse("its ICC profile is damaged");
  const cmsColorSpaceSignature space = cmsGetColorSpace(from.get());
  const cmsProfileClassSignature kind = cmsGetDeviceClass(from.get());
  if (kind == cmsSigLinkClass || kind == cmsSigAbstractClass || kind == cmsSigNamedColorClass)
    refuse("its ICC profile is none of a picture's colours (a link, an effect, names)");
  is_grey_profile_ = space == cmsSigGrayData;
  if (!is_grey_profile_ && space != cmsSigRgbData)
    refuse(fmt::format("its ICC profile is of {} colours; convert it to RGB", space_name(space)));
  if (is_grey_profile_ && colours_ == 3)
    refuse("its ICC profile is of grey, and its pixels have colours");
  const Profile to = linear_acescg();
  transform_ = std::shared_ptr<void>(
      cmsCreateTransform(from.get(), is_grey_profile_ ? TYPE_GRAY_FLT : TYPE_RGB_FLT, to.get(),
                         TYPE_RGB_FLT, INTENT_RELATIVE_COLORIMETRIC,
                         cmsFLAGS_NOOPTIMIZE | cmsFLAGS_NOCACHE),
      [](void* transform) {
        if (transform) cmsDeleteTransform(transform);
      });
  if (!transform_)
    refuse("its ICC profile says no way from its colours to light; convert it to sRGB");
  is_bounded_ = !has_endless_curves(from.get());
  xy_ = kAp1Places;
  words_.push_back(fmt::format("ICC profile '{}'", profile_name(from.get())));
}

void PictureColour::take_curve(const PictureClaims& claims, PixelEncoding encoding,
                               bool is_floating) {
  const auto take = [this](Curve curve, const char* words) {
    curve_ = curve;
    words_.emplace_back(words);
  };
  if (encoding == PixelEncoding::kLinear) return take(Curve::kLinear, "linear (as asked for)");
  if (encoding == PixelEncoding::kSrgb) return take(Curve::kSrgb, "sRGB (as asked for)");
  if (claims.srgb) return take(Curve::kSrgb, "sRGB (its sRGB chunk)");
  if (!claims.gamma)
    return is_floating ? take(Curve::kLinear, "linear (floats)")
                       : take(Curve::kSrgb, "sRGB (integers that say nothing else)");
  constexpr double kLeast = 0.1, kMost = 10;
  if (!(*claims.gamma >= kLeast && *claims.gamma <= kMost))
    refuse(fmt::format("its gAMA is {:g}; it must be {:g} to {:g}", *claims.gamma, kLeast, kMost));
  const bool is_linear = *claims.gamma == 1;
  exponent_ = static_cast<float>(1 / *claims.gamma);
  take(is_linear ? Curve::kLinear : Curve::kPower, "");
  const char* from = claims.xy_from == "EXIF" ? "EXIF" : "gAMA";
  words_.back() =
      is_linear ? "linear (gAMA)" : fmt::format("a power of {:.4g} ({})", exponent_, from);
}

void PictureColour::take_primaries(const PictureClaims& claims) {
  if (claims.srgb || !claims.xy) {
    words_.emplace_back(claims.srgb ? "primaries Rec.709 (its sRGB chunk)"
                                    : "primaries Rec.709 (none are stated)");
    return;
  }
  check_primaries(*claims.xy, claims.xy_from);
  const NamedPrimaries* known = known_primaries(*claims.xy);
  xy_ = known ? known->xy : *claims.xy;
  words_.push_back(known ? fmt::format("primaries {} ({})", known->name, claims.xy_from)
                         : fmt::format("primaries of its own ({})", claims.xy_from));
}

float PictureColour::linear(float v) const {
  constexpr float kScale = 1.09929683f, kLine = 4.5f * 0.01805397f;  // H.273, equation of code 1
  switch (curve_) {
    case Curve::kLinear:
      return v;
    case Curve::kPower:
      return std::pow(v, exponent_);
    case Curve::kRec709:
      return v < kLine ? v / 4.5f : std::pow((v + (kScale - 1)) / kScale, 1 / 0.45f);
    case Curve::kSrgb:
      break;
  }
  // IEC 61966-2-1.
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

void PictureColour::colours(const float* samples, std::size_t pixels, std::size_t step,
                            float* rgb) const {
  const bool grey = colours_ == 1;
  for (std::size_t k = 0; k < pixels; ++k)
    for (std::size_t c = 0; c < 3; ++c) rgb[3 * k + c] = samples[step * k + (grey ? 0 : c)];
  if (!transform_) {
    for (std::size_t k = 0; k < 3 * pixels; ++k) rgb[k] = linear(rgb[k]);
    return;
  }
  // Beyond a table Little CMS goes on with its ends.
  constexpr float kRounding = 1e-3f;
  for (std::size_t k = 0; is_bounded_ && k < 3 * pixels; ++k)
    if (rgb[k] < -kRounding || rgb[k] > 1 + kRounding)
      refuse(
          fmt::format("it has the value {:g}, and its ICC profile says only what 0 to 1 are; "
                      "convert it to linear OpenEXR",
                      rgb[k]));
  // Little CMS would make a number of what is none.
  std::vector<float> from(rgb, rgb + 3 * pixels), grey_only;
  if (is_grey_profile_)
    for (std::size_t k = 0; k < pixels; ++k) grey_only.push_back(from[3 * k]);
  cmsDoTransform(transform_.get(), is_grey_profile_ ? grey_only.data() : from.data(), rgb,
                 static_cast<cmsUInt32Number>(pixels));
  for (std::size_t k = 0; k < 3 * pixels; ++k)
    if (!std::isfinite(from[k])) rgb[k] = from[k];
}

void PictureColour::light(const float* samples, std::size_t pixels, bool has_alpha,
                          float* rgb) const {
  const std::size_t step = static_cast<std::size_t>(colours_) + (has_alpha ? 1 : 0);
  colours(samples, pixels, step, rgb);
  const bool multiply = has_alpha && alpha_ == Alpha::kUnassociated;
  for (std::size_t k = 0; k < pixels; ++k)
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * k + c] *= scale_[c] * (multiply ? samples[step * k + step - 1] : 1);
}

}  // namespace domefall
