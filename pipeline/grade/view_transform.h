// OpenColorIO configurations: their displays and views, the transform of a view, and what light a
// display makes of its codes.
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/grade/dome_light.h"
#include "pipeline/grade/grade_settings.h"
#include "pipeline/image/encode/display_colour.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {

struct ViewTransform {
  OCIO_NAMESPACE::ConstConfigRcPtr config;
  std::string display, name;
  OCIO_NAMESPACE::ConstTransformRcPtr transform;  // from the working space, with the settings' CDL
};

// Reads a configuration.  Throws InputError naming the file if it is none.
OCIO_NAMESPACE::ConstConfigRcPtr read_config(const std::string& file);

struct DisplayViews {
  std::string display;
  std::vector<std::string> views;
};

// Returns the active displays in the order of the configuration.  Throws InputError if the file is
// no configuration.
std::vector<DisplayViews> displays_of(const std::filesystem::path& config);

// Makes the transform of a view.  Throws InputError if the configuration has not the display or the view,
// with a list of those that it has, or no role by which frames can enter it.
ViewTransform chosen_view(const OCIO_NAMESPACE::ConstConfigRcPtr& config,
                          const GradeSettings& settings);

// Calls step().  What OpenColorIO throws becomes InputError, or TemporaryError for a missing file,
// and names the configuration's file and the view.
template <class Step>
void explained(const ViewTransform& view, const std::string& file, Step step) {
  const auto message = [&](const OCIO_NAMESPACE::Exception& error) {
    return fmt::format("{}: the view '{}' of the display '{}' cannot be made from {}: {}", file,
                       view.name, view.display, kWorkingSpaceName, error.what());
  };
  try {
    step();
  } catch (const OCIO_NAMESPACE::ExceptionMissingFile& error) {
    throw TemporaryError(message(error));
  } catch (const OCIO_NAMESPACE::Exception& error) {
    throw InputError(message(error));
  }
}

// Returns the luminance of each code of each channel alone, of which white has 1 in all, for the
// display and view of a configuration.  Throws InputError, which begins with `file`, if the colour
// space of that view is not one of a display, so that nothing is said about light.  It does so,
// too, if the display's light is not the sum of what the three channels give, or does not rise with
// the codes.
DomeLight::Curves display_curves(const OCIO_NAMESPACE::Config& config, const std::string& display,
                                 const std::string& view, const std::string& file);

// Returns what the codes of that view mean.  Returns nothing if the view's space is not one of a
// display, if its light is not the sum of what the three channels give by one curve (HLG aside), or
// if this curve is none of a power, sRGB's and HLG's to a thousandth of white, and PQ's to 0.2 %.
// Primaries within 3e-4 of a standard's are taken to be the standard's.
std::optional<DisplayColour> display_colour(const OCIO_NAMESPACE::Config& config,
                                            const std::string& display, const std::string& view);

}  // namespace domefall
