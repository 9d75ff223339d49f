// The program by which a farm makes its frames.
#pragma once

#include <string>

namespace domefall {

// The path by which the processes of a farm call domefall: what --program says, where a name alone
// is looked up in PATH, or else this program itself.  It is asked for its version.  Throws
// InputError for a name that PATH does not have, for a program that is here and cannot be run, and
// for another version.  One that is not here, but may be on the nodes, is warned of on standard
// error, or refused where it is `needed_here`.
std::string farm_program(const std::string& named, bool needed_here);

}  // namespace domefall
