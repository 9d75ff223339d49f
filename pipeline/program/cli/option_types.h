// These names say what the values of options are, in the words of --help and of the manual.  Bash
// completion goes by them when it offers files, folders, shows or the words in braces.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/program/cli/number_in.h"
#include "pipeline/show/overlay_kind.h"

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

// Add an option, or the argument of a verb, whose value is a file or a folder, or several.
template <class Value>
CLI::Option* add_file(CLI::App& verb, const char* name, Value& file, const std::string& help) {
  return verb.add_option(name, file, help)->type_name(kFileType);
}
template <class Value>
CLI::Option* add_folder(CLI::App& verb, const char* name, Value& folder, const std::string& help) {
  return verb.add_option(name, folder, help)->type_name(kFolderType);
}

inline CLI::Option* add_show(CLI::App& verb, std::string& file) {
  return add_file(verb, kShowName, file, "show file (YAML)");
}

inline void add_threads(CLI::App& verb, int& threads) {
  verb.add_option("--threads", threads, "0: one per processor")->check(number_in(0, 1024));
}

// What the help of the verbs says of it.
inline constexpr const char* kAudioHelp =
    "the sound of the whole show: one file, or one for each channel, whose names end in L, R, C, "
    "LFE, Ls, Rs or the like";

// Adds the option --overlay, whose value read_show() takes.
inline void add_overlay_option(CLI::App& verb, std::string& names) {
  std::vector<std::string_view> known;
  known.reserve(std::size(kOverlays));
  for (const auto& [kind, name] : kOverlays) known.push_back(name);
  verb.add_option("--overlay", names,
                  "draw over the frames, for review and teaching: any of these, joined by commas")
      ->type_name(one_of(known).append(kListMark))
      ->check([](const std::string& list) {
        return list.empty() ? std::string("got no name") : std::string();
      });
}

}  // namespace domefall
