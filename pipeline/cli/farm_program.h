// This file finds the program by which a farm makes its frames.
#pragma once

#include <string>

namespace domefall {

// Returns the path by which the processes of a farm call domefall.  It is what --program says, or
// else this program itself.  A name without a folder is looked up in PATH.  A named program is
// asked for its version.  Throws InputError for a name that PATH does not have, for a program that
// is here and cannot be run, and for another version.  A path at which there is nothing here may
// exist on the nodes.  It gets a warning on standard error, or is refused if it is `needed_here`.
std::string farm_program(const std::string& named, bool needed_here);

}  // namespace domefall
