// Text in the language of troff, of which manual pages are made.
#pragma once

#include <string>
#include <string_view>

namespace domefall {

// The text as it stands: no letter of it is taken for a command.  A dash stays one that can be
// copied to a shell.
std::string roff_text(std::string_view text);
std::string roff_bold(std::string_view text);
std::string roff_italic(std::string_view text);

// .SH with the title.
std::string roff_section(std::string_view title);

// Paragraphs with an empty line between them.  Each sentence begins a line, as troff asks.
std::string roff_paragraphs(std::string_view text);

}  // namespace domefall
