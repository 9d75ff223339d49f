// Each verb has its notes, whose examples are understood.

#include "pipeline/program/cli/verb_notes.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "pipeline/program/cli/verbs.h"

namespace domefall {
namespace {

using testing::HasSubstr;
using testing::Not;

// Calls use(verb, words) for the program and each of its verbs, with the words that are typed.
template <class Use>
void each_verb(const CLI::App& app, const std::string& words, const Use& use) {
  use(app, words);
  for (const CLI::App* verb : app.get_subcommands({}))
    each_verb(*verb, words + (words.empty() ? "" : " ") + verb->get_name(), use);
}

// Ends the reading of a command line before its verb begins.
struct WholeLineRead {};

TEST(VerbNotes, AreOfEachVerbAndOfNoOther) {
  std::vector<std::string> verbs, noted;
  each_verb(*describe_command_line(), "",
            [&](const CLI::App&, const std::string& words) { verbs.push_back(words); });
  for (const VerbNotes& notes : all_verb_notes()) noted.emplace_back(notes.verb);
  EXPECT_THAT(noted, testing::UnorderedElementsAreArray(verbs));
}

TEST(VerbNotes, ExamplesAreUnderstoodByTheirVerbs) {
  int examples = 0;
  for (const VerbNotes& notes : all_verb_notes())
    for (const auto& [line, what] : notes.examples) {
      const std::string command(line.substr(0, line.find_first_of("|>")));
      const std::string program_name = "domefall ";
      ASSERT_TRUE(command.starts_with(program_name + std::string(notes.verb))) << command;
      const auto program = describe_command_line();
      program->parse_complete_callback([] { throw WholeLineRead{}; });
      EXPECT_THROW(program->parse(command.substr(program_name.size())), WholeLineRead) << command;
      ++examples;
    }
  EXPECT_GT(examples, 20);
}

TEST(VerbNotes, EachOptionHasAMeaning) {
  each_verb(*describe_command_line(), "", [](const CLI::App& verb, const std::string& words) {
    for (const CLI::Option* option : verb.get_options())
      EXPECT_FALSE(option->get_description().empty()) << words << " " << option->get_name();
  });
}

TEST(VerbNotes, HelpClosesWithTheNotes) {
  const std::string help = describe_command_line()->help();
  EXPECT_THAT(help, HasSubstr("\n  75\n      It is worth trying again"));
  EXPECT_THAT(help, HasSubstr("DOMEFALL_ASSETS"));
  EXPECT_THAT(help, Not(HasSubstr("\\")));
}

}  // namespace
}  // namespace domefall
