// These names say what the values of options are, in the words of --help and of the manual.  Bash
// completion goes by them when it offers files, folders, shows or the words in braces.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace domefall {

inline constexpr const char *kFileType = "FILE", *kFolderType = "FOLDER", *kShowName = "SHOW";
// This mark follows the words of a list whose members are joined by commas.
inline constexpr std::string_view kListMark = ",...";

// Writes one of several words as CLI::IsMember does, such as {review,dome}.
template <class Names>
std::string one_of(const Names& names) {
  return fmt::format("{{{}}}", fmt::join(names, ","));
}

// Refuses an empty path.  It would stand for the default, which a script with an unset variable
// does not mean.
inline std::string refuse_empty(const std::string& path) {
  return path.empty() ? std::string("got an empty path") : std::string();
}

// Adds the argument that names the show.
inline CLI::Option* add_show(CLI::App& verb, std::string& file) {
  return verb.add_option(kShowName, file, "show file (YAML)")->type_name(kFileType);
}

}  // namespace domefall
