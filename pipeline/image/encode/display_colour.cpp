#include "pipeline/image/encode/display_colour.h"

#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace domefall {
namespace {

bool is_srgb(const DisplayColour& colour) {
  return colour.curve == DisplayColour::Curve::kSrgb && colour.xy == kRec709Places;
}

// PNG's numbers are whole, in units of 1e-5.
std::string png_part(double value) {
  return png_number(static_cast<std::uint32_t>(std::lround(value * 1e5)));
}

// DisplayColour::gamma is the exponent that decodes, and PNG states its inverse.  For sRGB the
// number is the specification's (second edition, 11.3.3.5).
std::string png_gamma(const DisplayColour& colour) {
  constexpr double kOfSrgb = 0.45455;
  return png_part(colour.curve == DisplayColour::Curve::kSrgb ? kOfSrgb : 1 / colour.gamma);
}

// These are the primaries of DCI-P3 after Bradford's adaptation of its white to D65.
constexpr std::array<double, 8> kAdaptedDci{0.6807, 0.3189, 0.2812, 0.6742,
                                            0.1488, 0.0577, 0.3127, 0.3290};

void require_lcms(bool done) {
  if (!done) throw std::runtime_error("Little CMS could not make a profile of the display");
}

cmsCIExyY place_of(const DisplayColour& colour, std::size_t k) {
  return {colour.xy[2 * k], colour.xy[2 * k + 1], 1};
}

bool is_hdr(const DisplayColour& colour) {
  return colour.curve == DisplayColour::Curve::kPq || colour.curve == DisplayColour::Curve::kHlg;
}

// The last two numbers say RGB itself and the full range.
std::string png_code_points(const DisplayColour& colour) {
  const int transfer = colour.curve == DisplayColour::Curve::kPq ? kH273Pq : kH273Hlg;
  return {static_cast<char>(h273_primaries(colour.xy)), static_cast<char>(transfer), 0, 1};
}

}  // namespace

double pq_light(double code) {
  constexpr double kM1 = 2610. / 16384, kM2 = 2523. / 32, kC1 = 3424. / 4096, kC2 = 2413. / 128,
                   kC3 = 2392. / 128, kMost = 10000;
  const double power = std::pow(code, 1 / kM2);
  return kMost * std::pow(std::max(power - kC1, 0.0) / (kC2 - kC3 * power), 1 / kM1);
}

int h273_primaries(const std::array<double, 8>& xy) {
  const std::array<std::pair<int, std::array<double, 8>>, 5> known{{{1, kRec709Places},
                                                                    {9, kRec2020Places},
                                                                    {11, kDciP3Places},
                                                                    {11, kAdaptedDci},
                                                                    {12, kP3D65Places}}};
  constexpr double kNear = 1e-3;
  for (const auto& [code, places] : known)
    if (std::equal(xy.begin(), xy.end(), places.begin(),
                   [](double a, double b) { return std::abs(a - b) <= kNear; }))
      return code;
  return 2;
}

std::vector<PngChunk> png_colour_chunks(const DisplayColour& colour) {
  std::vector<PngChunk> chunks;
  if (is_srgb(colour)) chunks.push_back({"sRGB", std::string(1, '\0')});  // intent: perceptual
  if (is_hdr(colour))
    chunks.push_back({"cICP", png_code_points(colour)});
  else
    chunks.push_back({"gAMA", png_gamma(colour)});
  std::string places;
  for (const std::size_t k : {6U, 7U, 0U, 1U, 2U, 3U, 4U, 5U}) places += png_part(colour.xy[k]);
  chunks.push_back({"cHRM", places});
  return chunks;
}

std::string icc_profile(const DisplayColour& colour) {
  if (is_hdr(colour)) return {};
  using Curve = std::unique_ptr<cmsToneCurve, void (*)(cmsToneCurve*)>;
  constexpr double kSrgb[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  constexpr int kPowerType = 1, kSrgbType = 4;
  const bool power = colour.curve == DisplayColour::Curve::kPower;
  const Curve curve(cmsBuildParametricToneCurve(nullptr, power ? kPowerType : kSrgbType,
                                                power ? &colour.gamma : kSrgb),
                    cmsFreeToneCurve);
  require_lcms(curve != nullptr);
  const cmsCIExyY white = place_of(colour, 3);
  const cmsCIExyYTRIPLE primaries{place_of(colour, 0), place_of(colour, 1), place_of(colour, 2)};
  cmsToneCurve* curves[] = {curve.get(), curve.get(), curve.get()};
  using Profile = std::unique_ptr<void, int (*)(void*)>;
  const Profile profile(cmsCreateRGBProfile(&white, &primaries, curves), cmsCloseProfile);
  require_lcms(profile != nullptr);
  cmsUInt32Number size = 0;
  require_lcms(cmsSaveProfileToMem(profile.get(), nullptr, &size) != 0);
  std::string bytes(size, '\0');
  require_lcms(cmsSaveProfileToMem(profile.get(), bytes.data(), &size) != 0);
  // A profile's header holds the time of its creation in 12 bytes (ICC.1, 7.2), which would make
  // every file different.  It is replaced by the first midnight of 1970.
  constexpr std::size_t kDate = 24;
  constexpr char kMidnight[] = {0x07, '\xb2', 0, 1, 0, 1, 0, 0, 0, 0, 0, 0};
  bytes.replace(kDate, sizeof kMidnight, kMidnight, sizeof kMidnight);
  return bytes;
}

}  // namespace domefall
