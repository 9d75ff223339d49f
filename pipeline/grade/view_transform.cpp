#include "pipeline/grade/view_transform.h"

#include <algorithm>
#include <cctype>
#include <vector>

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

}  // namespace

ocio::ConstConfigRcPtr read_config(const std::string& file) {
  try {
    return ocio::Config::CreateFromFile(file.c_str());
  } catch (const ocio::Exception& error) {
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

}  // namespace domefall
