// What --help, and so the manual, says about a verb beyond its options.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace domefall {

struct VerbNotes {
  std::string_view verb;  // as it is typed: render, sky import; empty: the program itself
  std::string_view
      about;  // paragraphs with an empty line between them; lines of at most 78 letters
  std::vector<std::pair<std::string_view, std::string_view>> examples;  // a command, what it does
  std::string_view document;                                            // below docs, or empty
};

// Returns the notes in the order of the verbs.
const std::vector<VerbNotes>& all_verb_notes();

// Returns what --help says after the options.
std::string help_footer(const VerbNotes& notes);

}  // namespace domefall
