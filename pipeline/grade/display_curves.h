// This file says what light a display makes of its codes, as an OpenColorIO configuration has it.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <optional>
#include <string>

#include "pipeline/grade/dome_light.h"
#include "pipeline/image/encode/display_colour.h"

namespace domefall {

// Returns the luminance of each code of each channel alone, of which white has 1 in all, for the
// display and view of a configuration.  Throws InputError, which begins with `file`, if the colour
// space of that view is not one of a display, so that nothing is said about light.  It does so,
// too, if the display's light is not the sum of what the three channels give, or does not rise with
// the codes.
DomeLight::Curves display_curves(const OCIO_NAMESPACE::Config& config, const std::string& display,
                                 const std::string& view, const std::string& file);

// Returns what the codes of that view mean.  Returns nothing if the view's space is not one of a
// display, if its light is not the sum of what the three channels give by one curve, or if this
// curve is neither a power nor that of sRGB to a thousandth of white.  Primaries within 3e-4 of a
// standard's are taken to be the standard's.
std::optional<DisplayColour> display_colour(const OCIO_NAMESPACE::Config& config,
                                            const std::string& display, const std::string& view);

}  // namespace domefall
