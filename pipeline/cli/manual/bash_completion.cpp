#include "pipeline/cli/manual/bash_completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "pipeline/cli/manual/described_option.h"
#include "pipeline/cli/option_types.h"

namespace domefall {
namespace {

// A TypedVerb is a verb with all its words, as it is typed.
struct TypedVerb {
  std::string words;
  const CLI::App* verb;
};

void collect(const CLI::App& app, const std::string& words, std::vector<TypedVerb>& all) {
  all.push_back({words, &app});
  for (const CLI::App* verb : verbs_of(app))
    collect(*verb, words.empty() ? verb->get_name() : words + " " + verb->get_name(), all);
}

// Returns what may stand for a value, in the words of _domefall_complete.  That is "other" where
// the completion cannot know it.
std::string completion_kind(const DescribedOption& option) {
  const std::string many = option.takes_many ? "many " : "";
  if (!option.words.empty())
    return fmt::format("{}{} {}", many, option.joins_words ? "list" : "words",
                       fmt::join(option.words, " "));
  if (option.is_argument && option.names.front() == kShowName) return many + "show";
  if (option.value == kFileType) return many + "file";
  if (option.value == kFolderType) return many + "folder";
  return many + "other";
}

std::string verbs_function(const std::vector<TypedVerb>& all) {
  std::string text =
      "# Sets `kind` to the verbs that may follow the verb $1; false where none may.\n"
      "_domefall_verbs() {\n  case $1 in\n";
  for (const auto& [words, verb] : all) {
    std::vector<std::string> below;
    for (const CLI::App* each : verbs_of(*verb)) below.push_back(each->get_name());
    if (!below.empty())
      text += fmt::format("    '{}') kind='{}' ;;\n", words, fmt::join(below, " "));
  }
  return text + "    *) return 1 ;;\n  esac\n}\n\n";
}

std::string options_function(const std::vector<TypedVerb>& all) {
  std::string text = "# Prints the options of the verb $1.\n_domefall_options() {\n  case $1 in\n";
  for (const auto& [words, verb] : all) {
    std::vector<std::string> names;
    for (const DescribedOption& option : described_options(*verb))
      for (const std::string& name : option.names)
        if (name.starts_with("--")) names.push_back(name);
    text += fmt::format("    '{}') echo '{}' ;;\n", words, fmt::join(names, " "));
  }
  return text + "  esac\n}\n\n";
}

std::string values_function(const std::vector<TypedVerb>& all) {
  std::string text =
      "# Sets `kind` to what may stand for the value of option $2 of the verb $1, or for the "
      "verb's\n"
      "# argument of that number, from 0; false where it takes none.\n"
      "_domefall_value() {\n  case \"$1 $2\" in\n";
  for (const auto& [words, verb] : all) {
    int place = 0;
    for (const DescribedOption& option : described_options(*verb)) {
      if (!option.takes_value) continue;
      std::vector<std::string> labels;
      if (option.is_argument)
        labels.push_back(fmt::format("'{} {}'", words, place++));
      else
        for (const std::string& name : option.names)
          labels.push_back(fmt::format("'{} {}'", words, name));
      text +=
          fmt::format("    {}) kind='{}' ;;\n", fmt::join(labels, " | "), completion_kind(option));
    }
  }
  return text + "    *) return 1 ;;\n  esac\n}\n\n";
}

constexpr std::string_view kCompletionFrame =
#include "pipeline/cli/manual/completion_frame.inc"
    ;

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::vector<TypedVerb> all;
  collect(program, "", all);
  return "# shellcheck shell=bash\n# Bash completion of domefall, made of what its --help "
         "shows.\n\n" +
         verbs_function(all) + options_function(all) + values_function(all) +
         std::string(kCompletionFrame);
}

}  // namespace domefall
