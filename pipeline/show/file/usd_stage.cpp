#include "pipeline/show/file/usd_stage.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

struct Token {
  enum class Kind { kWord, kNumber, kText, kSign, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  // of a text without its quotes
  double number = 0;
  int line = 1;

  bool is(std::string_view sign) const {
    return (kind == Kind::kSign || kind == Kind::kWord) && text == sign;
  }
};

// A UsdWords divides a text into its words, numbers, quoted texts and signs.
class UsdWords {
 public:
  UsdWords(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {
    next();
  }

  const Token& now() const { return token_; }
  // Goes on to the next word, and returns the one that was there.
  Token next() {
    Token passed = std::move(token_);
    token_ = read();
    return passed;
  }
  bool take(std::string_view sign) {
    if (!token_.is(sign)) return false;
    next();
    return true;
  }
  void expect(std::string_view sign) {
    if (!take(sign)) fail(fmt::format("'{}' is missing", sign));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, token_.line, what));
  }

 private:
  void pass_blanks() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        line_ += text_[at_++] == '\n';
      else
        return;
    }
  }

  // Takes what stands between marks.
  Token between(std::string_view mark, std::string_view end, bool escapes) {
    Token token{Token::Kind::kText, {}, 0, line_};
    at_ += mark.size();
    for (; at_ < text_.size() && !text_.substr(at_).starts_with(end); ++at_) {
      if (escapes && text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      line_ += text_[at_] == '\n';
      token.text += text_[at_];
    }
    if (at_ >= text_.size())
      throw InputError(fmt::format("{}:{}: {} does not end", file_, token.line, mark));
    at_ += end.size();
    return token;
  }

  Token read() {
    pass_blanks();
    if (at_ >= text_.size()) return {Token::Kind::kEnd, "the end", 0, line_};
    const std::string_view rest = text_.substr(at_);
    for (const std::string_view mark : {R"(""")", "'''", R"(")", "'"})
      if (rest.starts_with(mark)) return between(mark, mark, true);
    for (const std::string_view mark : {"@@@", "@"})
      if (rest.starts_with(mark)) return between(mark, mark, false);
    if (rest[0] == '<') return between("<", ">", false);
    double number = 0;
    const char* begin = rest.data();
    const auto [end, error] = std::from_chars(begin, begin + rest.size(), number);
    const bool is_number =
        std::string_view("+-.0123456789").find(rest[0]) != std::string_view::npos;
    if (is_number && error == std::errc()) {
      at_ += static_cast<std::size_t>(end - begin);
      return {Token::Kind::kNumber, std::string(begin, end), number, line_};
    }
    // Words have colons within them, and time codes one behind them.
    std::size_t length = 0;
    while (rest[0] != ':' && length < rest.size() && is_of_word(rest[length])) ++length;
    const bool word = length > 0;
    Token token{word ? Token::Kind::kWord : Token::Kind::kSign,
                std::string(rest.substr(0, word ? length : 1)), 0, line_};
    at_ += token.text.size();
    return token;
  }

  static bool is_of_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '.' ||
           c == '!';
  }

  std::string file_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  Token token_;
};

class UsdReader {
 public:
  UsdReader(const std::string& file, std::string_view text) : words_(file, text) {}

  UsdStage read() {
    UsdStage stage;
    if (words_.now().is("(")) read_head(stage);
    while (words_.now().kind != Token::Kind::kEnd) read_prim(stage.root, 0);
    return stage;
  }

 private:
  // A stage counts its time codes by one of two rates, of which the first goes before the other.
  void read_head(UsdStage& stage) {
    std::map<std::string, UsdValue, std::less<>> said;
    words_.expect("(");
    while (!words_.take(")")) {
      const Token name = words_.next();
      if (name.kind == Token::Kind::kEnd) words_.fail("')' is missing");
      if (words_.take("=")) said[name.text] = read_value();
    }
    for (const char* rate : {"framesPerSecond", "timeCodesPerSecond"})
      if (const auto found = said.find(rate); found != said.end()) {
        if (found->second.numbers.size() != 1 || !(found->second.numbers[0] > 0))
          words_.fail(std::string(rate) + " must be a number above 0");
        stage.codes_per_second = found->second.numbers[0];
      }
    const auto up = said.find("upAxis");
    stage.z_is_up = up != said.end() && up->second.texts == std::vector<std::string>{"Z"};
  }

  void read_prim(UsdPrim& parent, int depth) {
    constexpr int kDeepest = 200;
    if (depth > kDeepest) words_.fail("this is too deep");
    if (!words_.now().is("def") && !words_.now().is("over") && !words_.now().is("class"))
      words_.fail(fmt::format("'{}' stands where an object should begin", words_.now().text));
    auto prim = std::make_unique<UsdPrim>();
    prim->line = words_.next().line;
    prim->parent = &parent;
    if (words_.now().kind == Token::Kind::kWord) prim->type = words_.next().text;
    if (words_.now().kind != Token::Kind::kText) words_.fail("the name of an object is missing");
    prim->path = parent.path + "/" + words_.next().text;
    if (words_.now().is("(")) pass_group();
    words_.expect("{");
    while (!words_.take("}")) read_statement(*prim, depth + 1);
    parent.children.push_back(std::move(prim));
  }

  void read_statement(UsdPrim& prim, int depth) {
    const Token& now = words_.now();
    if (now.kind == Token::Kind::kEnd) words_.fail("'}' is missing");
    if (now.is("def") || now.is("over") || now.is("class")) return read_prim(prim, depth);
    // An attribute's name is the last word before its value, or on its line.
    const int line = now.line;
    std::string name;
    while (!words_.now().is("=") && !words_.now().is("}") && words_.now().line == line &&
           words_.now().kind != Token::Kind::kEnd) {
      if (words_.now().is("(") || words_.now().is("{")) {
        pass_group();
        continue;
      }
      name = words_.next().text;
    }
    if (!words_.take("=")) {
      if (name.empty()) words_.fail(fmt::format("'{}' cannot stand here", words_.now().text));
      return;
    }
    constexpr std::string_view kSamples = ".timeSamples";
    if (name.ends_with(kSamples)) {
      name.resize(name.size() - kSamples.size());
      read_samples(prim.attributes[name]);
    } else {
      prim.attributes[name].fixed = read_value();
    }
    if (words_.now().is("(")) pass_group();
  }

  void read_samples(UsdAttribute& attribute) {
    words_.expect("{");
    while (!words_.take("}")) {
      if (words_.now().kind != Token::Kind::kNumber)
        words_.fail(fmt::format("'{}' is no time code", words_.now().text));
      const double time = words_.next().number;
      words_.expect(":");
      attribute.samples[time] = read_value();
      words_.take(",");
    }
  }

  // Takes all that stands within brackets, or what stands alone.
  UsdValue read_value() {
    UsdValue value;
    if (words_.now().is("{")) {
      pass_group();
      return value;
    }
    int depth = 0;
    do {
      const Token token = words_.next();
      if (token.kind == Token::Kind::kEnd) words_.fail("a value does not end");
      if (token.kind == Token::Kind::kNumber) value.numbers.push_back(token.number);
      if (token.kind == Token::Kind::kText) value.texts.push_back(token.text);
      depth += token.is("(") || token.is("[") ? 1 : token.is(")") || token.is("]") ? -1 : 0;
    } while (depth > 0);
    return value;
  }

  void pass_group() {
    int depth = 0;
    do {
      const Token token = words_.next();
      if (token.kind == Token::Kind::kEnd) words_.fail("a bracket is not closed");
      const bool opens = token.is("(") || token.is("[") || token.is("{");
      const bool closes = token.is(")") || token.is("]") || token.is("}");
      depth += opens ? 1 : closes ? -1 : 0;
    } while (depth > 0);
  }

  UsdWords words_;
};

}  // namespace

UsdValue UsdAttribute::at(double time) const {
  if (samples.empty()) return fixed;
  const auto after = samples.lower_bound(time);
  if (after == samples.end()) return samples.rbegin()->second;
  if (after == samples.begin() || after->first == time) return after->second;
  const auto& [begin, before] = *std::prev(after);
  UsdValue between = before;
  const double part = (time - begin) / (after->first - begin);
  for (std::size_t k = 0; k < between.numbers.size() && k < after->second.numbers.size(); ++k)
    between.numbers[k] = std::lerp(between.numbers[k], after->second.numbers[k], part);
  return between;
}

UsdStage read_usd_stage(const std::string& file, std::string_view text) {
  return UsdReader(file, text).read();
}

}  // namespace domefall
