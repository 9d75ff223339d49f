#include "pipeline/program/cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/utf8.h"
#include "pipeline/program/cli/verb_notes.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {

namespace {

struct Verb {
  std::string_view name;
  void (*add)(CLI::App& app);
};

constexpr std::array kVerbs{
    Verb{"check", add_check},     Verb{"render", add_render},     Verb{"grade", add_grade},
    Verb{"preview", add_preview}, Verb{"movie", add_movie},       Verb{"deliver", add_deliver},
    Verb{"sheet", add_sheet},     Verb{"timeline", add_timeline}, Verb{"farm", add_farm},
    Verb{"states", add_states},   Verb{"probe", add_probe},       Verb{"trace", add_trace},
    Verb{"report", add_report},   Verb{"stars", add_stars},       Verb{"sky", add_sky},
};

// Throws InputError for a word that is no verb.
void check_verb(std::string_view word) {
  std::vector<std::string_view> known(kVerbs.size());
  std::ranges::transform(kVerbs, known.begin(), &Verb::name);
  if (std::ranges::find(known, word) != known.end()) return;
  const std::string near = did_you_mean(word, known);
  throw InputError("domefall has no verb '" + shown(word) + "'" +
                   (near.empty() ? "; it has " + listed(known) : near));
}

// Throws InputError for an argument that is empty or has a control character.  The first comes from a
// variable that a script has not set, and would count as an option that was not given.  The second
// would become a path in lists, plans, scripts and the arguments of other programs.
void check_arguments(std::span<char* const> arguments) {
  bool is_ours = true;  // what follows "--" is sbatch's
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string_view argument = arguments[k];
    const std::string before = k > 0 ? arguments[k - 1] : "";
    refuse_control_characters(argument, before.starts_with('-') ? before + " " : "");
    is_ours = is_ours && argument != "--";
    if (is_ours && argument.empty())
      throw InputError(fmt::format(
          "argument {}, after '{}', is empty; leave the option out, or say what is meant", k,
          printable(before)));
  }
}

// Says what CLI11 says, which may hold an argument, and returns the exit code.
int end_by(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream said;
  const int code = app.exit(error, std::cout, said);
  if (const std::string text = said.str(); !text.empty()) say(text);
  return code == 0 ? 0 : kBadInput;
}

// Returns the verb that notes are about.  Throws CLI::OptionNotFound where there is none, so that
// no test can miss it.
CLI::App& verb_of(CLI::App& app, const VerbNotes& notes) {
  CLI::App* verb = &app;
  for (const std::string& word : CLI::detail::split(std::string(notes.verb), ' '))
    if (!word.empty()) verb = verb->get_subcommand(word);
  return *verb;
}

// An option that lacks its value takes the next word for it, even if that is an option as well:
// `--deliver --dry-run` would begin in earnest.
void refuse_options_as_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options([](const CLI::Option* o) {
         return !o->get_positional() && o->get_items_expected_max() > 0;
       }))
    option->check([](const std::string& value) {
      return value.starts_with("--") && value.size() > 2
                 ? fmt::format("got the option {0}; a file of this name is ./{0}", value)
                 : std::string();
    });
  for (CLI::App* verb : app.get_subcommands({})) refuse_options_as_values(*verb);
}

// Describes the verbs for which `is_wanted(name)`, and the program itself.
template <class IsWanted>
std::unique_ptr<CLI::App> describe_verbs(const IsWanted& is_wanted) {
  auto app = std::make_unique<CLI::App>(
      "Black-hole shows for planetariums: a show file in, graded Domemaster frames out",
      "domefall");
  app->set_version_flag("--version", "domefall " DOMEFALL_VERSION);
  app->require_subcommand(1);
  for (const Verb& verb : kVerbs)
    if (is_wanted(verb.name)) verb.add(*app);
  for (const VerbNotes& notes : all_verb_notes()) {
    const std::string_view name = notes.verb.substr(0, notes.verb.find(' '));
    if (name.empty() || is_wanted(name)) verb_of(*app, notes).footer(help_footer(notes));
  }
  refuse_options_as_values(*app);
  return app;
}

}  // namespace

std::unique_ptr<CLI::App> describe_command_line() {
  return describe_verbs([](std::string_view) { return true; });
}

int run_command_line(int argc, char** argv) {
  check_arguments({argv, static_cast<std::size_t>(argc)});
  const std::string_view first = argc > 1 ? argv[1] : "-";
  const bool is_verb = !first.starts_with('-'), is_version = argc == 2 && first == "--version";
  if (is_verb) check_verb(first);
  // Only the verb that is used is described, because all would take a fifth of the program's start.
  const std::unique_ptr<CLI::App> app =
      describe_verbs([&](std::string_view name) { return is_verb ? name == first : !is_version; });
  // A wrong DOMEFALL_SIMD is refused before anything is made.
  app->parse_complete_callback([] { simd_in_use(); });
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return end_by(*app, error);
  }
  return 0;
}

}  // namespace domefall
