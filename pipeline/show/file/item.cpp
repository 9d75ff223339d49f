#include "pipeline/show/file/item.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"
#include "pipeline/show/file/yaml_document.h"

namespace domefall {
namespace {

constexpr std::size_t kMostListed = 100;

// yaml-cpp gives the tag "!" to quoted text, and "?" to text without quotes.
bool is_quoted(const Item& item) { return item.node.Tag() == "!"; }

// Says what cannot be seen of a text that a message shows.
std::string which_is_odd(std::string_view text) {
  const std::string odd = odd_character(text);
  return odd.empty() ? "" : ", which " + odd;
}

// Says so of the first key of a map: a list whose dash is another one becomes a map.
std::string odd_first_key(const YAML::Node& map) {
  if (map.size() == 0 || !map.begin()->first.IsScalar()) return "";
  const std::string& key = map.begin()->first.Scalar();
  const std::string odd = odd_character(key);
  return odd.empty() ? "" : " whose key '" + shown(key) + "' " + odd;
}

std::string in_unit(const Range& range) {
  return range.unit.empty() ? "" : fmt::format(" ({})", range.unit);
}

// Returns the characters of a scalar.  Reports an item that is no scalar, and one with a tag or an
// open quote.
std::optional<std::string> scalar(const Item& item, const std::string& wanted) {
  if (!item.node.IsScalar()) return item.fail("must be " + wanted + ", got " + kind_of(item));
  // A tag such as !!str would say of what kind a value is, which in a show its key decides.
  const std::string& tag = item.node.Tag();
  if (!tag.empty() && tag != "?" && tag != "!")
    return item.fail("bears the YAML tag '" + shown(tag) + "'; shows use none");
  // yaml-cpp lets the end of the file close a quote, so that the comment which parse_yaml() has
  // appended becomes a part of the text.
  if (is_quoted(item) && item.node.Scalar().find(kEndOfShow) != std::string::npos)
    return item.fail("opens a quote that is never closed");
  return item.node.Scalar();
}

bool is_yaml_special(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  const auto is = [&](std::string_view word) {
    return std::ranges::equal(text, word, {}, [](unsigned char c) { return std::tolower(c); });
  };
  return is(".nan") || is(".inf");
}

// Says whether a number that no double holds is beyond the largest one, and not below the smallest.
// std::from_chars() has one error for both, while std::strtod() returns infinity or a number next
// to 0.
bool is_huge(const std::string& text) { return std::isinf(std::strtod(text.c_str(), nullptr)); }

// Returns the advice for a text that would be a number without its `rest`.  The rest begins with
// what the parser stopped at: a decimal comma, a group of digits, a number in base 60 (YAML 1.1 had
// these), or a unit.  An x stands in hexadecimal numbers, for which there is no advice.
std::string_view mended(std::string_view rest, const Range& range) {
  if (rest.empty()) return "; leave the quotes out";
  if (rest[0] == ',') return "; write a decimal point";
  if (rest[0] == '_') return "; write the digits without '_'";
  if (rest[0] == ':') return "; write one decimal number, not parts of sixty";
  return range.unit.empty() || rest[0] == 'x' ? "" : "; leave the unit out";
}

// Says what the value must do to keep the bound that it breaks, or returns nothing if it keeps
// both.  Each test is negated, so that NaN breaks every bound.
std::optional<std::string> broken_bound(const Range& range, double value) {
  if (range.low_excluded && !(value > range.low)) return "exceed " + short_number(range.low);
  if (!range.low_excluded && !(value >= range.low)) return "be at least " + short_number(range.low);
  if (range.high_excluded && !(value < range.high)) return "stay below " + short_number(range.high);
  if (!range.high_excluded && !(value <= range.high))
    return "be at most " + short_number(range.high);
  return std::nullopt;
}

}  // namespace

Problems::Problems(std::string file, std::string text) : file_(std::move(file)) {
  // The text is split into lines once, since each message needs the one that it is about.
  std::istringstream in(std::move(text));
  for (std::string line; std::getline(in, line);) lines_.push_back(std::move(line));
  if (lines_.empty()) lines_.emplace_back();
}

void Problems::add(TextPlace at, const std::string& what) {
  problems_.push_back({at, what});
  mistaken_ = true;
}

void Problems::add_missing_file(TextPlace at, const std::string& what) {
  problems_.push_back({at, what});
}

std::string Problems::place(TextPlace at) const {
  // yaml-cpp reports what is missing at the end of the file at a place beyond the last line.
  const bool at_end = at.line >= static_cast<int>(lines_.size());
  const std::size_t line = at_end ? lines_.size() - 1 : static_cast<std::size_t>(at.line);
  const std::size_t bytes = at_end ? lines_[line].size() : static_cast<std::size_t>(at.column);
  const std::string before = lines_[line].substr(0, bytes);
  const auto column =
      before.size() - static_cast<std::size_t>(std::ranges::count_if(before, continues_character));
  return fmt::format("{}:{}:{}: ", file_, line + 1, column + 1);
}

void Problems::raise() const {
  if (problems_.empty()) return;
  std::vector<Problem> sorted = problems_;
  std::ranges::stable_sort(sorted, [](const Problem& a, const Problem& b) {
    return std::pair(a.at.line, a.at.column) < std::pair(b.at.line, b.at.column);
  });
  std::string message;
  for (std::size_t k = 0; k < std::min(sorted.size(), kMostListed); ++k)
    message.append(k > 0 ? "\n" : "").append(place(sorted[k].at)).append(sorted[k].what);
  if (sorted.size() > kMostListed)
    message += fmt::format("\n{}: and {} more", file_, sorted.size() - kMostListed);
  // Files that are missing here may be there on another machine, where the same show can succeed.
  // One mistake among them fails everywhere.
  if (!mistaken_) throw TemporaryError(message);
  throw InputError(message);
}

std::nullopt_t Item::fail(const std::string& what) const {
  problems->add(at, (path.empty() ? "the show" : path) + " " + what);
  return std::nullopt;
}

void Item::miss_file(const std::string& what) const {
  problems->add_missing_file(at, (path.empty() ? "the show" : path) + " " + what);
}

std::string kind_of(const Item& item) {
  if (item.node.IsMap()) return "a map" + odd_first_key(item.node);
  if (item.node.IsSequence()) return "a list";
  // A key without a value has a null node, which is no map, list or scalar.
  if (!item.node.IsScalar()) return "nothing";
  return std::string(is_quoted(item) ? "the text '" : "'")
      .append(shown(item.node.Scalar()))
      .append("'")
      .append(which_is_odd(item.node.Scalar()));
}

std::optional<std::string> read_text(const Item& item) {
  auto text = scalar(item, "text");
  if (!text) return std::nullopt;
  if (text->find_first_not_of(' ') == std::string::npos) return item.fail("must not be empty");
  if (!first_control_character(*text).empty())
    return item.fail("must be one line without control characters, got '" + shown(*text) + "'");
  return text;
}

std::optional<std::string> read_lines(const Item& item) {
  auto text = scalar(item, "text");
  if (!text) return std::nullopt;
  // A block of YAML ends with a line end that is no line of the text.
  const std::size_t first = text->find_first_not_of(" \n"), last = text->find_last_not_of(" \n");
  if (first == std::string::npos) return item.fail("must not be empty");
  std::string letters = *text;
  std::erase(letters, '\n');
  if (!first_control_character(letters).empty())
    return item.fail("may have no control characters but ends of lines, got '" + shown(*text) +
                     "'");
  return text->substr(first, last + 1 - first);
}

std::optional<double> read_number(const Item& item, const Range& range) {
  const std::string wanted = "a number" + in_unit(range);
  const auto text = scalar(item, wanted);
  if (!text) return std::nullopt;
  // from_chars takes no plus sign.  Unlike std::strtod() it ignores the locale, in which a comma
  // may be the decimal point.
  const bool has_plus = text->starts_with('+') && !text->starts_with("+-");
  const char* begin = text->data() + (has_plus ? 1 : 0);
  const char* end = text->data() + text->size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  // A number too large for a double counts as infinite.  If it breaks a bound, the message names
  // that bound instead of the limits of a double.
  const bool too_large = error == std::errc::result_out_of_range && is_huge(*text);
  if (too_large) value = text->starts_with('-') ? -HUGE_VAL : HUGE_VAL;
  const bool bounded = too_large && stop == end && broken_bound(range, value);
  if (!bounded && (error == std::errc::result_out_of_range || is_yaml_special(*text) ||
                   (error == std::errc() && stop == end && !std::isfinite(value)))) {
    return item.fail("must be a finite number" + in_unit(range) + " that a double holds, got " +
                     shown(*text));
  }
  // A number in quotes is text to YAML, and one with a rest behind its digits is no number.
  if (is_quoted(item) || (error != std::errc() && !bounded) || stop != end)
    return item.fail("must be " + wanted + ", got " + kind_of(item) +
                     std::string(stop == begin || !odd_character(*text).empty()
                                     ? ""
                                     : mended({stop, end}, range)));
  return in_range(item, value, range);
}

std::optional<double> in_range(const Item& item, double value, const Range& range) {
  const auto bound = broken_bound(range, value);
  if (!bound) return value;
  // The reason is that of the lower bound, and is left out where the upper one is broken.
  const bool low = value <= range.low && !range.low_reason.empty();
  return item.fail("must " + *bound + in_unit(range) + ", got " + as_written(item) +
                   (low ? ": " + std::string(range.low_reason) : ""));
}

std::optional<int> read_whole_number(const Item& item, const Range& range) {
  const auto value = read_number(item, range);
  if (!value) return std::nullopt;
  // The ranges of whole numbers in shows end at 1e9, which an int holds.
  if (*value == std::floor(*value)) return static_cast<int>(*value);
  return item.fail("must be a whole number" + in_unit(range) + ", got " + as_written(item));
}

std::string as_written(const Item& item) { return shown(item.node.Scalar()); }

bool is_word(const Item& item, std::string_view word) {
  return item.node.IsScalar() && item.node.Scalar() == word;
}

std::optional<std::size_t> read_choice(const Item& item, std::span<const std::string_view> words) {
  const auto text = scalar(item, listed(words));
  if (!text) return std::nullopt;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (*text == words[k]) return k;
  return item.fail("must be " + listed(words) + ", got '" + shown(*text) + "'" +
                   did_you_mean(*text, words));
}

std::optional<std::vector<Item>> read_list(const Item& item) {
  if (!item.node.IsSequence() || item.node.size() == 0)
    return item.fail(std::string("must be a list of at least one entry, got ") +
                     (item.node.IsSequence() ? "an empty one" : kind_of(item)));
  std::vector<Item> items;
  for (const auto& child : item.node) {
    const auto mark = child.Mark();
    items.push_back({static_cast<const YAML::Node&>(child),
                     {mark.line, mark.column},
                     fmt::format("{}[{}]", item.path, items.size() + 1),
                     item.problems});
  }
  return items;
}

std::optional<std::vector<double>> read_numbers(const Item& item, std::size_t count,
                                                const Range& range) {
  if (!item.node.IsSequence() || item.node.size() != count)
    return item.fail(
        fmt::format("must be a list of {} numbers{}, got {}", count, in_unit(range),
                    item.node.IsSequence() ? fmt::to_string(item.node.size()) : kind_of(item)));
  std::vector<double> values;
  const auto children = read_list(item);
  for (const Item& child : *children)
    if (const auto value = read_number(child, range)) values.push_back(*value);
  if (values.size() < count) return std::nullopt;
  return values;
}

}  // namespace domefall
