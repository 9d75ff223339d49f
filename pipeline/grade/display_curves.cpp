#include "pipeline/grade/display_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "pipeline/image/errors.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

namespace {

using Pixel = std::array<float, 3>;

// Returns the colour space that a view's codes are in.
ocio::ConstColorSpaceRcPtr space_of(const ocio::Config& config, const std::string& display,
                                    const std::string& view) {
  const char* name = config.getDisplayViewColorSpaceName(display.c_str(), view.c_str());
  const bool display_is_space = std::strcmp(name, ocio::OCIO_VIEW_USE_DISPLAY_NAME) == 0;
  return config.getColorSpace(display_is_space ? display.c_str() : name);
}

// Returns the processor from codes to CIE XYZ, to which the colour spaces of displays refer.
ocio::ConstCPUProcessorRcPtr to_light(const ocio::Config& config, const ocio::ColorSpace& space) {
  auto transform = space.getTransform(ocio::COLORSPACE_DIR_TO_REFERENCE);
  auto direction = ocio::TRANSFORM_DIR_FORWARD;
  if (!transform) {
    transform = space.getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE);
    direction = ocio::TRANSFORM_DIR_INVERSE;
  }
  if (!transform) transform = ocio::GroupTransform::Create();  // the space is the reference
  return config.getProcessor(transform, direction)
      ->getOptimizedCPUProcessor(ocio::BIT_DEPTH_F32, ocio::BIT_DEPTH_F32,
                                 ocio::OPTIMIZATION_LOSSLESS);
}

void send_through(const ocio::CPUProcessor& cpu, std::vector<Pixel>& pixels) {
  ocio::PackedImageDesc image(pixels.data(), static_cast<long>(pixels.size()), 1, 3);
  cpu.apply(image);
}

bool is_sum_of_channels(const ocio::CPUProcessor& cpu) {
  constexpr std::array<Pixel, 4> kMixed{
      {{0.2f, 0.6f, 0.9f}, {0.8f, 0.3f, 0.5f}, {0.05f, 0.9f, 0.4f}, {1, 1, 1}}};
  for (const Pixel& mixed : kMixed) {
    std::vector<Pixel> parts{mixed, {mixed[0], 0, 0}, {0, mixed[1], 0}, {0, 0, mixed[2]}, {}};
    send_through(cpu, parts);
    for (std::size_t c = 0; c < 3; ++c) {
      const float sum = parts[1][c] + parts[2][c] + parts[3][c] - 2 * parts[4][c];
      if (!(std::abs(parts[0][c] - sum) <= 1e-4f)) return false;
    }
  }
  return true;
}

}  // namespace

DomeLight::Curves display_curves(const ocio::Config& config, const std::string& display,
                                 const std::string& view, const std::string& file) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format(
        "{}: dome.light cannot be had with the view '{}' of the display '{}', {}; choose another "
        "view or display, or leave out dome.light",
        file, view, display, why));
  };
  const auto space = space_of(config, display, view);
  if (!space || space->isData() || space->getReferenceSpaceType() != ocio::REFERENCE_SPACE_DISPLAY)
    refuse("whose codes are not in the colour space of a display, so that their light is unknown");
  const auto cpu = to_light(config, *space);
  if (!is_sum_of_channels(*cpu)) refuse("whose light is not the sum of that of its channels");
  DomeLight::Curves curves;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<Pixel> codes(kCodes, Pixel{});
    for (std::size_t code = 0; code < codes.size(); ++code)
      codes[code][c] = static_cast<float>(code) / (kCodes - 1);
    send_through(*cpu, codes);
    std::vector<double>& curve = curves[c];
    curve.reserve(codes.size());
    for (const Pixel& xyz : codes) curve.push_back(xyz[1] - codes[0][1]);
    if (!std::is_sorted(curve.begin(), curve.end(), std::less_equal<>()))
      refuse("whose light does not rise from code to code");
  }
  return curves;
}

namespace {

constexpr double kLikeEnough = 1e-3;  // of white

std::array<double, 2> chromaticity(const Pixel& xyz, const Pixel& black) {
  const double x = xyz[0] - black[0], y = xyz[1] - black[1], z = xyz[2] - black[2];
  return {x / (x + y + z), y / (x + y + z)};
}

// Returns the primaries and the white of the standard that these are near, or else these, rounded
// to four decimals.
std::array<double, 8> settled(std::array<double, 8> xy) {
  constexpr double kNear = 3e-4, kSteps = 1e4;
  for (const auto& standard : {kRec709Places, kRec2020Places, kDciP3Places, kP3D65Places})
    if (std::ranges::equal(xy, standard,
                           [](double a, double b) { return std::abs(a - b) < kNear; }))
      return standard;
  for (double& value : xy) value = std::round(kSteps * value) / kSteps;
  return xy;
}

// Sets the curve by the light of grey codes, white being 1.  Returns false if the curve is neither
// that of sRGB nor a power.
bool take_curve(const std::vector<double>& greys, DisplayColour& colour) {
  const auto last = static_cast<double>(greys.size() - 1);
  const auto fits = [&](const auto& curve) {
    for (std::size_t k = 0; k < greys.size(); ++k)
      if (!(std::abs(greys[k] - curve(static_cast<double>(k) / last)) <= kLikeEnough)) return false;
    return true;
  };
  const auto srgb = [](double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
  };
  if (fits(srgb)) {
    colour.curve = DisplayColour::Curve::kSrgb;
    return true;
  }
  constexpr double kSteps = 1000;
  const std::size_t middle = greys.size() / 2;
  const double gamma = std::log(greys[middle]) / std::log(static_cast<double>(middle) / last);
  colour.curve = DisplayColour::Curve::kPower;
  colour.gamma = std::round(kSteps * gamma) / kSteps;
  return fits([&](double code) { return std::pow(code, colour.gamma); });
}

}  // namespace

std::optional<DisplayColour> display_colour(const ocio::Config& config, const std::string& display,
                                            const std::string& view) {
  const auto space = space_of(config, display, view);
  if (!space || space->isData() || space->getReferenceSpaceType() != ocio::REFERENCE_SPACE_DISPLAY)
    return std::nullopt;
  const auto cpu = to_light(config, *space);
  if (!is_sum_of_channels(*cpu)) return std::nullopt;
  std::vector<Pixel> corners{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 0, 0}};
  send_through(*cpu, corners);
  const Pixel black = corners.back();
  DisplayColour colour;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [x, y] = chromaticity(corners[k], black);
    colour.xy[2 * k] = x, colour.xy[2 * k + 1] = y;
  }
  if (!std::ranges::all_of(colour.xy, [](double v) { return std::isfinite(v); }))
    return std::nullopt;
  colour.xy = settled(colour.xy);
  constexpr std::size_t kGreys = 257;
  std::vector<Pixel> ramp(kGreys);
  for (std::size_t k = 0; k < kGreys; ++k)
    ramp[k].fill(static_cast<float>(k) / static_cast<float>(kGreys - 1));
  send_through(*cpu, ramp);
  std::vector<double> greys;
  greys.reserve(kGreys);
  for (const Pixel& xyz : ramp)
    greys.push_back((xyz[1] - black[1]) / static_cast<double>(corners[3][1] - black[1]));
  return take_curve(greys, colour) ? std::optional(colour) : std::nullopt;
}

}  // namespace domefall
