// These functions write text in the language of troff, of which manual pages are made.
#pragma once

#include <string>
#include <string_view>

namespace domefall {

// Returns the text as it stands, without any letter that troff would take for a command.  A dash
// stays one that can be copied to a shell.
std::string roff_text(std::string_view text);
std::string roff_bold(std::string_view text);
std::string roff_italic(std::string_view text);

// Returns .SH with the title.
std::string roff_section(std::string_view title);

// Returns the paragraphs of a text, which has empty lines between them.  Each sentence begins a
// line, as troff asks.
std::string roff_paragraphs(std::string_view text);

}  // namespace domefall
