// Reads a file as a YAML tree, and turns each of its syntax errors into a message with a place.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>

#include "pipeline/show/problems.h"

namespace domefall {

// The file's bytes without a byte order mark.  Throws as require_file and RegularFile, and
// InputError if it exceeds 1 MiB.
std::string read_show_text(const std::filesystem::path& file);

// The words of a comment that is appended before parsing.  yaml-cpp 0.7 lets the end of the file
// close an open quote, whose text then ends with these words.
inline constexpr std::string_view kEndOfShow = "end of the show file";

// The root of the text's only document; undefined if there is none.  Syntax errors, bytes that are
// not UTF-8, control characters, nesting too deep and further documents raise `problems`.
YAML::Node parse_yaml(const std::string& text, Problems& problems);

}  // namespace domefall
