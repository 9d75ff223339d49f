// These functions read a file as a YAML tree, and turn each of its syntax errors into a message
// with a place.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>

#include "pipeline/show/file/item.h"

namespace domefall {

// Returns the file's text in UTF-8 without a byte-order mark.  Throws as require_file, RegularFile
// and as_utf8 do, and InputError if the file exceeds 1 MiB.
std::string read_show_text(const std::filesystem::path& file);

// A comment of these words is appended before parsing.  yaml-cpp 0.7 lets the end of the file close
// an open quote, whose text then ends with these words.
inline constexpr std::string_view kEndOfShow = "end of the show file";

// Returns the root of the text's only document, which is YAML or JSON, or an undefined node if
// there is none.  Its places are those of the text.  Syntax errors, bytes that are not UTF-8,
// control characters, nesting too deep and further documents raise `problems`.
YAML::Node parse_yaml(const std::string& text, Problems& problems);

}  // namespace domefall
