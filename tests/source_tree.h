// Where the files of the source tree are that tests read.
#pragma once

#include <string>

namespace domefall {

// The absolute path of `name`, a path from the root of the tree. Only this function's object file
// knows where the tree is, so that a compiler cache can share all others between trees.
std::string source_file(const std::string& name);

}  // namespace domefall
