#include "tests/source_tree.h"

namespace domefall {

std::string source_file(const std::string& name) { return DOMEFALL_SOURCE_DIR "/" + name; }

}  // namespace domefall
