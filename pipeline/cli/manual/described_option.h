// A DescribedOption is an option of the command line as the manual and bash completion need it,
// taken from CLI11.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace domefall {

struct DescribedOption {
  std::vector<std::string>
      names;                 // with their dashes; of an argument without dashes its name alone
  bool is_argument = false;  // it is known by its place, not by its name
  bool is_required = false;
  bool takes_value = false, takes_many = false;
  std::string value;               // what the value is called: FILE, FOLDER, INT; empty for words
  std::vector<std::string> words;  // those that the value may be; empty: others
  bool joins_words = false;        // several of them, joined by commas
  std::string bounds, standard;    // "from 0 to 1", and the default; empty: none
  std::string meaning;
  std::vector<std::string> needs, excludes;  // names of other options, sorted
};

DescribedOption described(const CLI::Option& from);

// Returns the options of a verb in the order of --help, which itself comes first.
std::vector<DescribedOption> described_options(const CLI::App& verb);

// Returns the verbs below a verb, in the order of --help.
std::vector<const CLI::App*> verbs_of(const CLI::App& app);

}  // namespace domefall
