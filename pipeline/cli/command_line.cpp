#include "pipeline/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "pipeline/cli/verb_notes.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/show/problems.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {

namespace {

struct Verb {
  std::string_view name;
  void (*add)(CLI::App& app);
};

constexpr std::array kVerbs{
    Verb{"check", add_check},     Verb{"render", add_render}, Verb{"grade", add_grade},
    Verb{"preview", add_preview}, Verb{"movie", add_movie},   Verb{"deliver", add_deliver},
    Verb{"sheet", add_sheet},     Verb{"farm", add_farm},     Verb{"states", add_states},
    Verb{"probe", add_probe},     Verb{"trace", add_trace},   Verb{"report", add_report},
    Verb{"stars", add_stars},     Verb{"sky", add_sky},
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

// Returns the verb that notes are about.  Throws CLI::OptionNotFound where there is none, so that
// no test can miss it.
CLI::App& verb_of(CLI::App& app, const VerbNotes& notes) {
  CLI::App* verb = &app;
  for (const std::string& word : CLI::detail::split(std::string(notes.verb), ' '))
    if (!word.empty()) verb = verb->get_subcommand(word);
  return *verb;
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
  return app;
}

}  // namespace

std::unique_ptr<CLI::App> describe_command_line() {
  return describe_verbs([](std::string_view) { return true; });
}

int run_command_line(int argc, char** argv) {
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
    return app->exit(error) == 0 ? 0 : kBadInput;
  }
  return 0;
}

}  // namespace domefall
