#include "pipeline/cli/manual/roff.h"

#include <algorithm>
#include <cctype>

namespace domefall {
namespace {

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

// Says whether a sentence ends at place k of a text, before a space.
bool ends_sentence(std::string_view text, std::size_t k) {
  return (text[k] == '.' || text[k] == '?' || text[k] == '!') && k + 2 < text.size() &&
         text[k + 1] == ' ' && is_upper(text[k + 2]);
}

}  // namespace

std::string roff_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool begins_line = out.empty() || out.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\(rs";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '^')
      out += "\\(ha";
    else if (c == '~')
      out += "\\(ti";
    else
      out += c;
  }
  return out;
}

std::string roff_bold(std::string_view text) { return "\\fB" + roff_text(text) + "\\fR"; }
std::string roff_italic(std::string_view text) { return "\\fI" + roff_text(text) + "\\fR"; }

std::string roff_section(std::string_view title) { return ".SH " + roff_text(title) + "\n"; }

std::string roff_paragraphs(std::string_view text) {
  std::string lines;
  for (std::size_t k = 0; k < text.size(); ++k) {
    lines += text[k];
    if (text[k] == '\n' && k + 1 < text.size() && text[k + 1] == '\n') lines += ".PP";
    if (ends_sentence(text, k)) lines += '\n', ++k;
  }
  std::string out;
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', from), lines.size());
    const std::string_view line = std::string_view(lines).substr(from, end - from);
    out += (line == ".PP" ? std::string(line) : roff_text(line)) + "\n";
    from = end + 1;
  }
  return out;
}

}  // namespace domefall
