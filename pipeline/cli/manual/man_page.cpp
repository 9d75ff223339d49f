#include "pipeline/cli/manual/man_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pipeline/cli/manual/described_option.h"
#include "pipeline/cli/manual/roff.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/verb_notes.h"

namespace domefall {
namespace {

const VerbNotes& notes_of(const std::string& verb) {
  const auto& all = all_verb_notes();
  const auto found = std::ranges::find(all, verb, &VerbNotes::verb);
  if (found == all.end()) throw std::logic_error("the verb " + verb + " has no notes");
  return *found;
}

std::string page_name(const std::string& verb) {
  return verb.empty() ? "domefall" : "domefall-" + verb;
}

std::string page_head(const std::string& verb, const std::string& date, std::string what) {
  std::string upper = page_name(verb);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  // A description that begins with an abbreviation keeps its capital.
  if (what.size() > 1 && !std::isupper(static_cast<unsigned char>(what[1])))
    what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
  return fmt::format(".TH {} 1 {} \"Domefall {}\" \"Domefall Manual\"\n", roff_text(upper), date,
                     DOMEFALL_VERSION) +
         roff_section("NAME") +
         fmt::format("{} \\- {}\n", roff_text(page_name(verb)), roff_text(what));
}

// Returns how a value is written, as FILE, one|other, or NAME,... for several words.
std::string value_text(const DescribedOption& option) {
  if (option.joins_words) return roff_italic("NAME") + ",...";
  if (option.words.empty()) return roff_italic(option.value);
  return roff_bold(fmt::format("{}", fmt::join(option.words, "|")));
}

std::string synopsis_of(const CLI::App& verb, const std::string& command) {
  std::string line = roff_bold(command);
  const std::vector<DescribedOption> options = described_options(verb);
  for (const DescribedOption& option : options)
    if (option.is_argument) {
      const std::string name = roff_italic(option.names.front()) + (option.takes_many ? "..." : "");
      line += option.is_required ? " " + name : " [" + name + "]";
    }
  for (const DescribedOption& option : options)
    if (!option.is_argument && option.is_required)
      line += " " + roff_bold(option.names.front()) + " " +
              roff_italic(option.value.empty() ? "WORD" : option.value);
  return line + " [" + roff_italic("OPTION") + "]...\n";
}

// Returns what follows an option's meaning, which is its bounds, its default and other options.
std::string small_print(const DescribedOption& option) {
  std::vector<std::string> facts;
  if (option.joins_words || (option.is_argument && !option.words.empty()))
    facts.push_back(fmt::format("{}", fmt::join(option.words, ", ")));
  if (!option.bounds.empty()) facts.push_back(option.bounds);
  if (!option.standard.empty()) facts.push_back("default " + option.standard);
  if (!option.needs.empty())
    facts.push_back(fmt::format("needs {}", fmt::join(option.needs, ", ")));
  if (!option.excludes.empty())
    facts.push_back(fmt::format("not with {}", fmt::join(option.excludes, ", ")));
  return facts.empty() ? "" : fmt::format(" ({})", fmt::join(facts, "; "));
}

std::string option_text(const DescribedOption& option) {
  std::string head;
  for (const std::string& name : option.names)
    head += (head.empty() ? "" : ", ") + (option.is_argument ? roff_italic(name) : roff_bold(name));
  if (option.takes_value && !option.is_argument) head += " " + value_text(option);
  if (option.takes_many) head += "...";
  return ".TP\n" + head + "\n" + roff_paragraphs(option.meaning + small_print(option));
}

std::string options_text(const CLI::App& verb) {
  std::string text;
  const std::vector<DescribedOption> options = described_options(verb);
  for (const bool arguments : {true, false})
    for (const DescribedOption& option : options)
      if (option.is_argument == arguments) text += option_text(option);
  return text;
}

std::string examples_text(const VerbNotes& notes) {
  std::string text;
  for (const auto& [command, what] : notes.examples)
    text += ".TP\n" + roff_bold(command) + "\n" + roff_paragraphs(what);
  return text;
}

std::string meanings_text(const std::vector<Meaning>& meanings) {
  std::string text;
  for (const auto& [name, meaning] : meanings)
    text += ".TP\n" + roff_bold(name) + "\n" + roff_paragraphs(meaning);
  return text;
}

std::string document_text(const VerbNotes& notes) {
  return ".PP\n" + roff_italic("/usr/share/doc/domefall/docs/" + std::string(notes.document)) +
         ", or the same file below the prefix of another installation, says more.\n";
}

std::string page_reference(const std::string& verb) {
  return fmt::format(".BR {} (1)", roff_text(page_name(verb)));
}

}  // namespace

std::string program_page(const CLI::App& program, const std::string& date) {
  const VerbNotes& notes = notes_of("");
  std::string text = page_head("", date, program.get_description());
  text += roff_section("SYNOPSIS") + roff_bold("domefall") + " " + roff_italic("VERB") + " [" +
          roff_italic("OPTION") + "]...\n";
  text += roff_section("DESCRIPTION") + roff_paragraphs(notes.about);
  text += roff_section("VERBS");
  std::string references;
  for (const CLI::App* verb : verbs_of(program)) {
    text += ".TP\n" + page_reference(verb->get_name()) + "\n" +
            roff_paragraphs(verb->get_description());
    references += page_reference(verb->get_name()) + " ,\n";
  }
  text += roff_section("OPTIONS") + options_text(program);
  text += roff_section("EXIT STATUS") + meanings_text(exit_code_meanings());
  text += roff_section("ENVIRONMENT") + meanings_text(environment_meanings());
  text +=
      roff_section("FILES") +
      meanings_text(
          {{"/usr/share/domefall/shows", "shows to begin with"},
           {"/usr/share/domefall/assets", "sky maps, star catalogues and the colour configuration"},
           {"/usr/share/domefall/farm", "what other queue managers read: Flamenco's job type"}});
  text += ".PP\nAnother prefix than /usr has them in the same places below it.\n";
  text += roff_section("EXAMPLES") + examples_text(notes);
  return text + roff_section("SEE ALSO") + references + roff_bold("ffmpeg") + "(1)\n" +
         document_text(notes);
}

std::string verb_page(const CLI::App& verb, const std::string& date) {
  const std::string& name = verb.get_name();
  const VerbNotes& notes = notes_of(name);
  std::string text = page_head(name, date, verb.get_description());
  const std::vector<const CLI::App*> below = verbs_of(verb);
  text += roff_section("SYNOPSIS");
  std::string details, examples = examples_text(notes);
  if (below.empty()) text += synopsis_of(verb, "domefall " + name);
  for (const CLI::App* each : below) {
    const std::string words = name + " " + each->get_name();
    const VerbNotes& part = notes_of(words);
    text += (each == below.front() ? "" : ".br\n") + synopsis_of(*each, "domefall " + words);
    details += roff_section("VERB " + words) + roff_paragraphs(each->get_description() + ".") +
               ".PP\n" + roff_paragraphs(part.about) + options_text(*each);
    examples += examples_text(part);
  }
  text += roff_section("DESCRIPTION") + roff_paragraphs(notes.about);
  text += below.empty() ? roff_section("OPTIONS") + options_text(verb) : details;
  text += roff_section("EXIT STATUS") + meanings_text(exit_code_meanings());
  text += roff_section("EXAMPLES") + examples;
  return text + roff_section("SEE ALSO") + page_reference("") + "\n" + document_text(notes);
}

}  // namespace domefall
