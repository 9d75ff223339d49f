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

// The colour space that a view's codes are in.
ocio::ConstColorSpaceRcPtr space_of(const ocio::Config& config, const std::string& display,
                                    const std::string& view) {
  const char* name = config.getDisplayViewColorSpaceName(display.c_str(), view.c_str());
  const bool display_is_space = std::strcmp(name, ocio::OCIO_VIEW_USE_DISPLAY_NAME) == 0;
  return config.getColorSpace(display_is_space ? display.c_str() : name);
}

// From codes to CIE XYZ, which displays refer to.
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

void apply(const ocio::CPUProcessor& cpu, std::vector<Pixel>& pixels) {
  ocio::PackedImageDesc image(pixels.data(), static_cast<long>(pixels.size()), 1, 3);
  cpu.apply(image);
}

bool is_sum_of_channels(const ocio::CPUProcessor& cpu) {
  constexpr std::array<Pixel, 4> kMixed{
      {{0.2f, 0.6f, 0.9f}, {0.8f, 0.3f, 0.5f}, {0.05f, 0.9f, 0.4f}, {1, 1, 1}}};
  for (const Pixel& mixed : kMixed) {
    std::vector<Pixel> parts{mixed, {mixed[0], 0, 0}, {0, mixed[1], 0}, {0, 0, mixed[2]}, {}};
    apply(cpu, parts);
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
    apply(*cpu, codes);
    std::vector<double>& curve = curves[c];
    curve.reserve(codes.size());
    for (const Pixel& xyz : codes) curve.push_back(xyz[1] - codes[0][1]);
    if (!std::is_sorted(curve.begin(), curve.end(), std::less_equal<>()))
      refuse("whose light does not rise from code to code");
  }
  return curves;
}

}  // namespace domefall
