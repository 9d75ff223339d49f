// Two kinds of things can go wrong outside the program, and they decide the exit code.
#pragma once

#include <stdexcept>

namespace domefall {

// An InputError is one that the user can mend, such as a wrong show or a missing or damaged input.
// The message carries the place ("show.yaml:4:12: ..."), what was wrong and the bound.  The exit
// code is 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A TemporaryError is worth trying again, here or elsewhere, such as a full disk or a file server
// that went away.  The exit code is 75.
struct TemporaryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace domefall
