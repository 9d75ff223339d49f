#include "pipeline/show/yaml_document.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <optional>
#include <sstream>

#include "pipeline/image/byte_order_mark.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/image/utf8.h"

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

// Returns the column of a tab in the indentation of a line.  yaml-cpp reports such a tab only some
// way behind it.
std::optional<int> tab_in_indentation(const std::string& text, int line) {
  std::size_t start = 0;
  for (int k = 0; k < line && start != std::string::npos; ++k) {
    start = text.find('\n', start);
    if (start != std::string::npos) ++start;
  }
  if (start == std::string::npos) return std::nullopt;
  // Only blanks may precede the tab, or it stands within the line and may be in order.
  const std::size_t at = text.find_first_not_of(' ', start);
  if (at == std::string::npos || text[at] != '\t') return std::nullopt;
  return static_cast<int>(at - start);
}

// Adds a syntax error, in words of our own where its cause is a common one.
void add_syntax_error(const YAML::ParserException& error, const std::string& text,
                      Problems& problems) {
  const TextPlace at{error.mark.line, error.mark.column};
  // yaml-cpp gives up at a fixed depth, since it parses by recursion and would overflow the stack.
  if (dynamic_cast<const YAML::DeepRecursion*>(&error))
    problems.add(at, "the show is nested too deeply");
  else if (const auto tab = tab_in_indentation(text, at.line))
    problems.add({at.line, *tab}, "a tab cannot indent YAML; use spaces");
  else
    problems.add(at, "this is not valid YAML: " + error.msg);
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
    // The first event of a document is that of its root.
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
  // A text of blanks and comments has no document.
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
  // One byte more than the limit tells a file that exceeds it from one that just reaches it.
  const std::string text = start_of_file(require_file(file), kLargestFile + 1);
  if (text.size() > kLargestFile)
    throw InputError(file.string() + ": a show file is at most 1 MiB; this one is larger");
  return std::string(without_byte_order_mark(text));
}

YAML::Node parse_yaml(const std::string& text, Problems& problems) {
  check_characters(text, problems);
  problems.raise();
  // The line end before the comment ends a last line that has none of its own.
  const std::string ended = text + "\n# " + std::string(kEndOfShow) + "\n";
  try {
    const bool any = check_documents(ended, problems);
    problems.raise();
    return any ? YAML::Load(ended) : YAML::Node(YAML::NodeType::Undefined);
  } catch (const YAML::ParserException& error) {
    add_syntax_error(error, text, problems);
  } catch (const YAML::Exception& error) {
    // For an exception that the parser did not throw, the beginning of the file stands in for the
    // place.
    problems.add({}, std::string("this is not valid YAML: ") + error.what());
  }
  problems.raise();
  return YAML::Node(YAML::NodeType::Undefined);
}

}  // namespace domefall
