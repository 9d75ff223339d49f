// These functions look at an OpenColorIO configuration before it is used.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <functional>
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

// These are what a child process may take: processor time, time by the clock, and memory beyond that
// of this process.
struct ChildBounds {
  int cpu_seconds = 5, seconds = 60, gibibytes = 4;
};

// Does first in another process what may end this one.  Calls `step` in a copy of this process, which has these bounds, writes nothing to the terminal,
// and is gone when this function returns.  What `step` changes is changed in the copy alone.  The
// copy has one thread, no handlers of signals and no files of this process.  `step` may need no
// lock that another thread of this process may hold.
//
// Throws InputError or TemporaryError as `step` does.  Throws InputError, which begins with `name`,
// if the copy crashes or takes more processor time or memory than these bounds, and TemporaryError
// if the copy cannot be made or has not ended in time, since it may wait for a slow disk.
void try_in_child(const std::string& name, const std::function<void()>& step,
                  const ChildBounds& bounds = {});

}  // namespace domefall
