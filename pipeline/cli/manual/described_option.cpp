#include "pipeline/cli/manual/described_option.h"

#include <algorithm>

#include "pipeline/cli/option_types.h"

namespace domefall {
namespace {

// Returns the names in alphabetical order, because CLI11 keeps options in the order of their
// addresses, which differs from run to run.
std::vector<std::string> sorted_names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::ranges::sort(names);
  return names;
}

// Takes the words of "{one,other}" or "{one,other},...".  Returns false for anything else.
bool take_words(const std::string& text, DescribedOption& option) {
  const auto end = text.find('}');
  if (!text.starts_with('{') || end == std::string::npos) return false;
  option.words = CLI::detail::split(text.substr(1, end - 1), ',');
  option.joins_words = text.substr(end + 1) == kListMark;
  return true;
}

}  // namespace

DescribedOption described(const CLI::Option& from) {
  DescribedOption option;
  option.is_argument = from.get_positional();
  option.names = CLI::detail::split(from.get_name(option.is_argument, true), ',');
  option.is_required = from.get_required();
  option.takes_value = from.get_items_expected_max() > 0;
  option.takes_many = from.get_items_expected_max() > 1;
  option.meaning = from.get_description();
  option.needs = sorted_names(from.get_needs());
  option.excludes = sorted_names(from.get_excludes());
  if (!option.takes_value) return option;
  option.standard = from.get_default_str();
  // CLI11 writes the type and what its checks say of themselves with colons between them.
  const std::string type = from.get_type_name();
  const auto colon = type.find(':');
  if (take_words(type, option)) return option;
  option.value = type.substr(0, colon);
  if (colon == std::string::npos) return option;
  const std::string check = type.substr(colon + 1);
  if (!take_words(check, option)) option.bounds = check;
  return option;
}

std::vector<DescribedOption> described_options(const CLI::App& verb) {
  std::vector<DescribedOption> options;
  for (const CLI::Option* option : verb.get_options()) options.push_back(described(*option));
  return options;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) { return app.get_subcommands({}); }

}  // namespace domefall
