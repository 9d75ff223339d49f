#include "pipeline/show/file/yaml_document.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

// This limit of docs/show-format.md keeps a file of another kind, such as a picture that was named
// by mistake, from being read and parsed as a whole.
constexpr std::size_t kLargestFile = 1 << 20;

// Reports the first character that has no place in a show.
void check_characters(std::string_view text, Problems& problems) {
  TextPlace at;
  for (std::size_t k = 0; k < text.size();) {
    const auto c = static_cast<unsigned char>(text[k]);
    const std::size_t length = character_length(text.substr(k));
    if (length == 0) {
      problems.add(at, fmt::format("the byte 0x{:02X} is not UTF-8; save the show as UTF-8", c));
      return;
    }
    if ((c < 0x20 && c != '\n' && c != '\r' && c != '\t') || c == 0x7F) {
      problems.add(at, fmt::format("the control character 0x{:02X} has no place in a show", c));
      return;
    }
    // Lines are counted by LF, here and in Problems, so that a text with bare CR would be one line
    // to every message.
    if (c == '\r' && !text.substr(k).starts_with("\r\n")) {
      problems.add(at, "the line ends with a bare carriage return; save the show with LF or CRLF");
      return;
    }
    k += length;
    at.column += static_cast<int>(length);
    if (c == '\n') at = {at.line + 1, 0};
  }
}

// Returns a line, counted from 0, or an empty text beyond the last one.
std::string_view line_of(std::string_view text, int line) {
  for (int k = 0; k < line; ++k) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

// Returns the column of a tab in the indentation of a line.  yaml-cpp reports such a tab only some
// way behind it.
std::optional<int> tab_in_indentation(std::string_view line) {
  const std::size_t at = line.find_first_not_of(' ');
  if (at == std::string_view::npos || line[at] != '\t') return std::nullopt;
  return static_cast<int>(at);
}

// Names a character in a line, or in the one before, that looks like a part of YAML and is none.
// Dashes are at home in titles, and can only be meant for a list at the start of a line.
std::string odd_in_lines(std::string_view text, int line) {
  for (const int each : {line, std::max(line - 1, 0)}) {
    std::string_view content = line_of(text, each);
    content.remove_prefix(std::min(content.find_first_not_of(' '), content.size()));
    const std::string odd = odd_character(content, false);
    const bool is_dash = odd.find("not a minus") != std::string::npos;
    if (!odd.empty() && (!is_dash || odd.starts_with("begins")))
      return fmt::format("; line {} {}", each + 1, odd);
  }
  return "";
}

// Adds a syntax error, in words of our own where its cause is a common one.
void add_syntax_error(const YAML::ParserException& error, const std::string& text,
                      Problems& problems) {
  const TextPlace at{error.mark.line, error.mark.column};
  // yaml-cpp gives up at a fixed depth, since it parses by recursion and would overflow the stack.
  if (dynamic_cast<const YAML::DeepRecursion*>(&error))
    problems.add(at, "the show is nested too deeply");
  else if (const auto tab = tab_in_indentation(line_of(text, at.line)))
    problems.add({at.line, *tab}, "a tab cannot indent YAML; use spaces");
  else if (error.msg.starts_with(YAML::ErrorMsg::UNKNOWN_ANCHOR))
    problems.add(at, "this alias (*) has no anchor (&) before it");
  else if (error.msg.starts_with(YAML::ErrorMsg::INVALID_UNICODE))
    problems.add(at,
                 "this escape is no character; halves of one, such as \\ud83e\\ude90, are read in "
                 "pairs and in shows that are JSON");
  else
    problems.add(at, "this is not valid YAML: " + error.msg + odd_in_lines(text, at.line));
}

std::optional<unsigned> escaped_unit(std::string_view text) {
  constexpr std::size_t kDigits = 4;
  if (!text.starts_with("\\u") || text.size() < 2 + kDigits) return std::nullopt;
  unsigned unit = 0;
  const char* end = text.data() + 2 + kDigits;
  const auto [stop, error] = std::from_chars(text.data() + 2, end, unit, 16);
  return error == std::errc() && stop == end ? std::optional(unit) : std::nullopt;
}

std::optional<unsigned> escaped_pair(std::string_view text) {
  constexpr std::size_t kEscape = 6;
  const auto high = escaped_unit(text);
  if (!high || *high < 0xD800 || *high >= 0xDC00) return std::nullopt;
  const auto low = escaped_unit(text.substr(kEscape));
  if (!low || *low < 0xDC00 || *low >= 0xE000) return std::nullopt;
  return 0x10000 + ((*high - 0xD800) << 10) + (*low - 0xDC00);
}

// Makes a show that is JSON one of YAML, of which JSON is a part but for two things: tabs between
// tokens become blanks, and a pair of escaped halves of a character becomes one escape.  That is
// two bytes shorter, which are made up for behind the closing quote, so that all places stay the
// same.
std::string json_as_yaml(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') return std::string(text);
  constexpr std::size_t kPair = 12;
  std::string yaml;
  bool quoted = false;
  std::size_t shorter = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (const auto code = quoted ? escaped_pair(text.substr(k)) : std::nullopt) {
      yaml += fmt::format("\\U{:08x}", *code);
      k += kPair - 1, shorter += 2;
    } else if (quoted && c == '\\') {
      yaml += text.substr(k++, 2);
    } else {
      yaml += c == '\t' && !quoted ? ' ' : c;
      if (c == '\n') shorter = 0;
      if (c == '"' && !(quoted = !quoted)) yaml.append(std::exchange(shorter, 0), ' ');
    }
  }
  return yaml;
}

// A Root keeps the place of a document's root.
class Root : public YAML::EventHandler {
 public:
  TextPlace at() const { return {mark_.line, mark_.column}; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { begin(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { begin(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    begin(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    begin(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    begin(mark);
  }
  void OnMapEnd() override {}

 private:
  void begin(const YAML::Mark& mark) {
    if (!begun_) mark_ = mark;
    begun_ = true;
  }

  bool begun_ = false;
  YAML::Mark mark_;
};

// Says whether there is a document, and reports a second one.  yaml-cpp 0.7 makes documents without
// end of a text that begins with a comma, all at one place, so that no more than two are asked for.
bool check_documents(const std::string& text, Problems& problems) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  Root first, second;
  if (!parser.HandleNextDocument(first)) return false;
  if (!parser.HandleNextDocument(second)) return true;
  const bool stuck = first.at().line == second.at().line && first.at().column == second.at().column;
  problems.add(second.at(), stuck
                                ? "this is not valid YAML: nothing can begin here"
                                : "a show file holds one YAML document; a second one starts here");
  return true;
}

}  // namespace

std::string read_show_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw InputError(file.string() + ": this is a folder; a show is a YAML file");
  const std::string text = start_of_file(require_file(file), kLargestFile + 1);
  if (text.size() > kLargestFile)
    throw InputError(file.string() + ": a show file is at most 1 MiB; this one is larger");
  return as_utf8(text, file);
}

YAML::Node parse_yaml(const std::string& text, Problems& problems) {
  check_characters(text, problems);
  problems.raise();
  // The line end before the comment ends a last line that has none of its own.
  const std::string ended = json_as_yaml(text) + "\n# " + std::string(kEndOfShow) + "\n";
  try {
    const bool any = check_documents(ended, problems);
    problems.raise();
    return any ? YAML::Load(ended) : YAML::Node(YAML::NodeType::Undefined);
  } catch (const YAML::ParserException& error) {
    add_syntax_error(error, text, problems);
  } catch (const YAML::Exception& error) {
    problems.add({}, std::string("this is not valid YAML: ") + error.what());
  }
  problems.raise();
  return YAML::Node(YAML::NodeType::Undefined);
}

}  // namespace domefall
