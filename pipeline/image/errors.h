// What can go wrong outside the program, in two kinds that decide the exit code.
#pragma once

#include <stdexcept>

namespace domefall {

// The user can mend it: a wrong show, a missing or damaged input.  The message carries the place
// ("show.yaml:4:12: ..."), what was wrong and the bound.  Exit code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Worth trying again, here or elsewhere: a full disk, a file server that went away.  Exit code 75.
struct TemporaryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace domefall
