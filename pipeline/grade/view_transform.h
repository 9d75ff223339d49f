// This file makes the transform that a grade consists of, from the working space to a display's
// codes.
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <string>

#include "pipeline/colour/colour_space.h"
#include "pipeline/grade/grade_settings.h"
#include "pipeline/image/errors.h"

namespace domefall {

struct ViewTransform {
  OCIO_NAMESPACE::ConstConfigRcPtr config;
  std::string display, name;
  OCIO_NAMESPACE::ConstTransformRcPtr transform;  // from the working space, with the settings' CDL
};

// Reads a configuration.  Throws InputError naming the file if it is none.
OCIO_NAMESPACE::ConstConfigRcPtr read_config(const std::string& file);

// Makes the transform.  Throws InputError if the configuration has not the display or the view,
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

}  // namespace domefall
