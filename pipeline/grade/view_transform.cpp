#include "pipeline/grade/view_transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

namespace {

// Returns the names at(0) to at(count - 1) in quotes, for a message.
template <class At>
std::string listed(int count, At at) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) names.push_back(fmt::format("'{}'", at(k)));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string chosen_display(const ocio::Config& config, const GradeSettings& settings) {
  if (settings.display.empty()) return config.getDefaultDisplay();
  for (int k = 0; k < config.getNumDisplays(); ++k)
    if (settings.display == config.getDisplay(k)) return settings.display;
  throw InputError(
      fmt::format("{} has no display '{}'; it has {}", settings.config.string(), settings.display,
                  listed(config.getNumDisplays(), [&](int k) { return config.getDisplay(k); })));
}

std::string view_name(const ocio::Config& config, const GradeSettings& settings,
                      const std::string& display) {
  if (settings.view.empty()) return config.getDefaultView(display.c_str());
  const int count = config.getNumViews(display.c_str());
  const auto at = [&](int k) { return config.getView(display.c_str(), k); };
  for (int k = 0; k < count; ++k)
    if (settings.view == at(k)) return settings.view;
  throw InputError(fmt::format("{} has no view '{}' for the display '{}'; it has {}",
                               settings.config.string(), settings.view, display,
                               listed(count, at)));
}

using Direction = ocio::TransformDirection;

void append_builtin(ocio::GroupTransform& group, const char* style,
                    Direction direction = ocio::TRANSFORM_DIR_FORWARD) {
  auto builtin = ocio::BuiltinTransform::Create();
  builtin->setStyle(style);
  builtin->setDirection(direction);
  group.appendTransform(builtin);
}

constexpr const char *kToAp0 = "ACEScg_to_ACES2065-1", *kAcescct = "ACEScct_to_ACES2065-1";

// Appends the CDL in ACEScct, which OpenColorIO knows whatever the configuration has.
void append_cdl(ocio::GroupTransform& group, const Cdl& values) {
  auto cdl = ocio::CDLTransform::Create();
  cdl->setSlope(values.slope.data());
  cdl->setOffset(values.offset.data());
  cdl->setPower(values.power.data());
  cdl->setSat(values.saturation);
  append_builtin(group, kToAp0);
  append_builtin(group, kAcescct, ocio::TRANSFORM_DIR_INVERSE);
  group.appendTransform(cdl);
  append_builtin(group, kAcescct);
  append_builtin(group, kToAp0, ocio::TRANSFORM_DIR_INVERSE);
}

bool names_acescg(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.find("acescg") != std::string::npos;
}

// Appends what takes the working space to a space of the configuration, and returns that space.
// What a role for interchange names is exact.  Older configurations have none, and of these
// scene_linear is ACEScg if it is called so, and linear Rec.709 otherwise, as in those that were
// shipped with compositing programs.
std::string append_change_to(ocio::GroupTransform& group, const ocio::Config& config,
                             const std::string& file) {
  if (config.hasRole(ocio::ROLE_INTERCHANGE_SCENE)) {
    append_builtin(group, kToAp0);
    return ocio::ROLE_INTERCHANGE_SCENE;
  }
  if (const auto space = config.getColorSpace(kWorkingSpaceName)) return space->getName();
  if (config.hasRole(ocio::ROLE_INTERCHANGE_DISPLAY)) {
    append_builtin(group, kToAp0);
    append_builtin(group, "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
    return ocio::ROLE_INTERCHANGE_DISPLAY;
  }
  if (!config.hasRole(ocio::ROLE_SCENE_LINEAR))
    throw InputError(file +
                     ": has none of the roles aces_interchange, cie_xyz_d65_interchange and "
                     "scene_linear, by one of which frames would enter it");
  const auto linear = config.getColorSpace(ocio::ROLE_SCENE_LINEAR);
  if (!names_acescg(linear->getName()))
    append_builtin(group, "UTILITY - ACES-AP1_to_LINEAR-REC709_BFD");
  return linear->getName();
}

// A view of data, such as Raw, shows the frame's own values.
bool is_data(const ocio::Config& config, const std::string& display, const std::string& view) {
  const auto space =
      config.getColorSpace(config.getDisplayViewColorSpaceName(display.c_str(), view.c_str()));
  return space && space->isData();
}

using Pixel = std::array<float, 3>;

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

// Sets the curve by the light of grey codes, white being 1.  Returns false if the curve is none of
// sRGB, PQ, HLG and a power.
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
  // White has 10000 cd/m^2, of which a dome shows the dark end, so that each grey must fit.
  const auto is_pq = [&] {
    constexpr double kWhite = 10000, kNear = 2e-3, kLeast = 1e-8;
    for (std::size_t k = 0; k < greys.size(); ++k) {
      const double light = pq_light(static_cast<double>(k) / last) / kWhite;
      if (!(std::abs(greys[k] - light) <= kNear * light + kLeast)) return false;
    }
    return true;
  };
  if (is_pq()) {
    colour.curve = DisplayColour::Curve::kPq;
    return true;
  }
  // The inverse of BT.2100's OETF, and the system gamma of 1000 cd/m^2.
  const auto hlg = [](double code) {
    constexpr double kA = 0.17883277, kB = 1 - 4 * kA, kC = 0.55991073, kGamma = 1.2;
    const double scene = code <= 0.5 ? code * code / 3 : (std::exp((code - kC) / kA) + kB) / 12;
    return std::pow(scene, kGamma);
  };
  if (fits(hlg)) {
    colour.curve = DisplayColour::Curve::kHlg;
    return true;
  }
  constexpr double kSteps = 1000;
  const std::size_t middle = greys.size() / 2;
  const double gamma = std::log(greys[middle]) / std::log(static_cast<double>(middle) / last);
  colour.curve = DisplayColour::Curve::kPower;
  colour.gamma = std::round(kSteps * gamma) / kSteps;
  return fits([&](double code) { return std::pow(code, colour.gamma); });
}

// Says at which line a configuration needs a newer OpenColorIO than this, if that is why it cannot
// be read, or else nothing.  The library's own message names no line.
std::string needs_newer(const std::string& file, const std::string& why) {
  constexpr std::string_view kProfile = "ocio_profile_version:", kStyle = "transform style '";
  std::string wanted;  // the built-in transform that the library does not know
  if (const auto at = why.find(kStyle); at != std::string::npos) {
    wanted = why.substr(at + kStyle.size());
    wanted.resize(std::min(wanted.size(), wanted.find('\'')));
  }
  const std::string here = ocio::GetVersion();
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    unsigned major = 0, minor = 0;
    if (line.starts_with(kProfile) &&
        std::sscanf(line.c_str() + kProfile.size(), "%u.%u", &major, &minor) >= 1 &&  // NOLINT
        ((major << 24U) | (minor << 16U)) > static_cast<unsigned>(ocio::GetVersionHex()))
      return fmt::format(
          "{}: line {}: a configuration of version {}.{} needs OpenColorIO {}.{} or newer, and "
          "this is "
          "{}",
          file, number, major, minor, major, minor, here);
    if (wanted.empty() || line.find(wanted) == std::string::npos) continue;
    return fmt::format("{}: line {}: OpenColorIO {} has no built-in transform '{}'; {}", file,
                       number, here, wanted,
                       wanted.ends_with("_2.0") ? "those of ACES 2 need 2.4 or newer"
                                                : "it is misspelt or needs a newer one");
  }
  return {};
}

}  // namespace

ocio::ConstConfigRcPtr read_config(const std::string& file) {
  try {
    return ocio::Config::CreateFromFile(file.c_str());
  } catch (const ocio::Exception& error) {
    if (const std::string newer = needs_newer(file, error.what()); !newer.empty())
      throw InputError(newer);
    throw InputError(file + ": not an OpenColorIO configuration that can be used: " + error.what());
  }
}

ViewTransform chosen_view(const ocio::ConstConfigRcPtr& config, const GradeSettings& settings) {
  ViewTransform chosen{config, chosen_display(*config, settings), {}, {}};
  chosen.name = view_name(*config, settings, chosen.display);
  auto group = ocio::GroupTransform::Create();
  if (settings.cdl != Cdl{}) append_cdl(*group, settings.cdl);
  auto view = ocio::DisplayViewTransform::Create();
  // OpenColorIO changes nothing from one space of data to another.
  const std::string source =
      is_data(*config, chosen.display, chosen.name)
          ? config->getDisplayViewColorSpaceName(chosen.display.c_str(), chosen.name.c_str())
          : append_change_to(*group, *config, settings.config.string());
  view->setSrc(source.c_str());
  view->setDisplay(chosen.display.c_str());
  view->setView(chosen.name.c_str());
  group->appendTransform(view);
  chosen.transform = group;
  return chosen;
}

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

std::optional<DisplayColour> display_colour(const ocio::Config& config, const std::string& display,
                                            const std::string& view) {
  const auto space = space_of(config, display, view);
  if (!space || space->isData() || space->getReferenceSpaceType() != ocio::REFERENCE_SPACE_DISPLAY)
    return std::nullopt;
  const auto cpu = to_light(config, *space);
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
  if (!take_curve(greys, colour)) return std::nullopt;
  // By the system gamma of HLG each channel's light depends on the others.
  if (colour.curve != DisplayColour::Curve::kHlg && !is_sum_of_channels(*cpu)) return std::nullopt;
  return colour;
}

std::vector<DisplayViews> displays_of(const std::filesystem::path& config) {
  const auto read = read_config(config.string());
  std::vector<DisplayViews> displays;
  for (int k = 0; k < read->getNumDisplays(); ++k) {
    const char* display = read->getDisplay(k);
    displays.push_back({display, {}});
    for (int v = 0; v < read->getNumViews(display); ++v)
      displays.back().views.emplace_back(read->getView(display, v));
  }
  return displays;
}

}  // namespace domefall
