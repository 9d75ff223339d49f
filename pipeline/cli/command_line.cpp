#include "pipeline/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
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

// Throws InputError if the command line begins with a word that is no verb.
void check_verb(const CLI::App& app, const char* word) {
  if (!word || word[0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  if (std::ranges::find(names, word) != names.end()) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string near = did_you_mean(word, known);
  throw InputError("domefall has no verb '" + shown(word) + "'" +
                   (near.empty() ? "; it has " + listed(known) : near));
}

// The verb that notes are about.  Throws where there is none, so that no test can miss it.
CLI::App& verb_of(CLI::App& app, const VerbNotes& notes) {
  CLI::App* verb = &app;
  for (const std::string& word : CLI::detail::split(std::string(notes.verb), ' '))
    if (!word.empty()) verb = verb->get_subcommand(word);
  return *verb;
}

}  // namespace

std::unique_ptr<CLI::App> describe_command_line() {
  auto app = std::make_unique<CLI::App>(
      "Black-hole shows for planetariums: a show file in, graded Domemaster frames out",
      "domefall");
  app->set_version_flag("--version", "domefall " DOMEFALL_VERSION);
  app->require_subcommand(1);
  add_check(*app);
  add_render(*app);
  add_grade(*app);
  add_preview(*app);
  add_movie(*app);
  add_deliver(*app);
  add_sheet(*app);
  add_farm(*app);
  add_states(*app);
  add_probe(*app);
  add_trace(*app);
  add_report(*app);
  add_stars(*app);
  add_sky(*app);
  for (const VerbNotes& notes : all_verb_notes()) verb_of(*app, notes).footer(help_footer(notes));
  return app;
}

int run_command_line(int argc, char** argv) {
  const std::unique_ptr<CLI::App> app = describe_command_line();
  // A wrong DOMEFALL_SIMD is told before anything is made.
  app->parse_complete_callback([] { simd_in_use(); });
  if (argc > 1) check_verb(*app, argv[1]);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? 0 : kBadInput;
  }
  return 0;
}

}  // namespace domefall
