// These functions read a file as a YAML tree, and turn each of its syntax errors into a message
// with a place.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>

#include "pipeline/show/problems.h"

namespace domefall {

// Returns the file's bytes without a byte order mark.  Throws as require_file and RegularFile do,
// and InputError if the file exceeds 1 MiB.
std::string read_show_text(const std::filesystem::path& file);

// A comment of these words is appended before parsing.  yaml-cpp 0.7 lets the end of the file close
// an open quote, whose text then ends with these words.
inline constexpr std::string_view kEndOfShow = "end of the show file";

// Returns the root of the text's only document, or an undefined node if there is none.  Syntax
// errors, bytes that are not UTF-8, control characters, nesting too deep and further documents
// raise `problems`.
YAML::Node parse_yaml(const std::string& text, Problems& problems);

}  // namespace domefall
