// The manual pages and the completion have all that --help has, and their examples are understood.

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <set>
#include <string>
#include <vector>

#include "pipeline/cli/manual/bash_completion.h"
#include "pipeline/cli/manual/described_option.h"
#include "pipeline/cli/manual/man_page.h"
#include "pipeline/cli/manual/roff.h"
#include "pipeline/cli/verb_notes.h"
#include "pipeline/cli/verbs.h"

namespace domefall {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kDay = "2026-01-02";

// All verbs of the program, as they are typed.
void collect_verbs(const CLI::App& app, const std::string& words, std::vector<std::string>& all) {
  all.push_back(words);
  for (const CLI::App* verb : verbs_of(app))
    collect_verbs(*verb, words + (words.empty() ? "" : " ") + verb->get_name(), all);
}

// Ends the reading of a command line before its verb begins.
struct WholeLineRead {};

TEST(Manual, HasNotesOfEachVerbAndOfNoOther) {
  std::vector<std::string> verbs, noted;
  collect_verbs(*describe_command_line(), "", verbs);
  for (const VerbNotes& notes : all_verb_notes()) noted.emplace_back(notes.verb);
  EXPECT_THAT(noted, testing::UnorderedElementsAreArray(verbs));
}

TEST(Manual, ExamplesAreUnderstoodByTheirVerbs) {
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

TEST(Manual, PagesHaveEachOptionWithItsBoundsAndDefault) {
  const auto program = describe_command_line();
  for (const CLI::App* verb : verbs_of(*program)) {
    const std::string page = verb_page(*verb, kDay);
    std::vector<const CLI::App*> parts = verbs_of(*verb);
    if (parts.empty()) parts = {verb};
    for (const CLI::App* part : parts)
      for (const DescribedOption& option : described_options(*part)) {
        for (const std::string& name : option.names)
          EXPECT_THAT(page, HasSubstr(option.is_argument ? roff_italic(name) : roff_bold(name)));
        EXPECT_FALSE(option.meaning.empty()) << verb->get_name() << " " << option.names.front();
        EXPECT_THAT(page, HasSubstr(roff_text(option.bounds)));
      }
    EXPECT_THAT(page, HasSubstr("EXIT STATUS"));
    EXPECT_THAT(program_page(*program, kDay), HasSubstr(roff_text("domefall-" + verb->get_name())));
  }
  const std::string page = verb_page(*program->get_subcommand("trace"), kDay);
  EXPECT_THAT(page, HasSubstr("(from 1e\\-13 to 0.001; default 1e\\-10)"));
  EXPECT_THAT(page, HasSubstr("table|exact|"));
}

TEST(Manual, OptionsAreTakenApart) {
  CLI::App app;
  int number = 3;
  std::string word;
  std::vector<std::string> files;
  auto* first = app.add_option("--number,-n", number, "how many")->capture_default_str();
  app.add_option("--word", word)->check(CLI::IsMember({"a", "b"}))->needs(first)->required();
  app.add_option("--list", word)->type_name("{c,d},...")->excludes(first);
  app.add_option("FILES", files)->type_name("FILE");
  app.set_help_flag();
  const std::vector<DescribedOption> options = described_options(app);
  ASSERT_EQ(options.size(), 4);
  EXPECT_THAT(options[0].names, ElementsAre("-n", "--number"));
  EXPECT_EQ(options[0].value, "INT");
  EXPECT_EQ(options[0].standard, "3");
  EXPECT_THAT(options[0].excludes, ElementsAre("--list"));
  EXPECT_THAT(options[1].words, ElementsAre("a", "b"));
  EXPECT_FALSE(options[1].joins_words);
  EXPECT_TRUE(options[1].is_required);
  EXPECT_THAT(options[1].needs, ElementsAre("--number"));
  EXPECT_THAT(options[2].words, ElementsAre("c", "d"));
  EXPECT_TRUE(options[2].joins_words);
  EXPECT_TRUE(options[3].is_argument && options[3].takes_many);
}

TEST(Manual, TextIsNeverTakenForCommands) {
  EXPECT_EQ(roff_text("a-b \\n"), "a\\-b \\(rsn");
  EXPECT_EQ(roff_paragraphs(".sky files"), "\\&.sky files\n");
  EXPECT_EQ(roff_paragraphs("One. Two, e.g. three.\n\n'Four'"),
            "One.\nTwo, e.g. three.\n.PP\n\\&\\(aqFour\\(aq\n");
}

TEST(Manual, HelpClosesWithTheNotes) {
  const std::string help = describe_command_line()->help();
  for (const auto& [code, meaning] : exit_code_meanings())
    EXPECT_THAT(help, HasSubstr("  " + std::string(code) + "\n      " + std::string(meaning)));
  EXPECT_THAT(help, HasSubstr("DOMEFALL_ASSETS"));
  EXPECT_THAT(help, Not(HasSubstr("\\")));
}

}  // namespace
}  // namespace domefall
