// These functions look at an OpenColorIO configuration before it is used.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>

namespace domefall {

// Throws InputError, which begins with `name`, if a variable of the configuration's context, or of
// the environment where the configuration declares none, refers to itself, since OpenColorIO would
// put it in its own place for ever.
void check_variables(const OCIO_NAMESPACE::Config& config, const std::string& name);

// Throws InputError, which begins with `name`, if a file that the configuration names is there and
// is empty or no regular file, since OpenColorIO would wait for a pipe.
void check_files(const OCIO_NAMESPACE::Config& config, const std::string& name);

// Sends pixels through each step of the processor by itself, in floats, since a later step may hide
// a NaN by clamping it.  Throws InputError, which begins with `name`, if a pixel of up to 1024
// becomes infinite, or one of up to the largest half becomes NaN.
void check_values(const OCIO_NAMESPACE::Config& config, const OCIO_NAMESPACE::Processor& processor,
                  const std::string& name);

}  // namespace domefall
