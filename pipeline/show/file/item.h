// An Item is a value in a show file, which knows its place and its path
// ("timeline[1].trajectory.from_r").  The readers below check its kind, unit and range.  A reader
// that finds a mistake reports it and returns nothing, so that the rest of the file is still
// checked.
#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/show/nearest_word.h"
#include "trajectories/short_number.h"

namespace domefall {

// A TextPlace is counted from 0 as yaml-cpp does, with the column in bytes.
struct TextPlace {
  int line = 0, column = 0;
};

class Problems {
 public:
  // `file` is the name that the user gave, and `text` the file's content.
  Problems(std::string file, std::string text);

  // Adds a mistake of the show's author.
  void add(TextPlace at, const std::string& what);
  // Adds a file that is missing or cannot be read, though another machine may have it.
  void add_missing_file(TextPlace at, const std::string& what);

  std::size_t count() const { return problems_.size(); }

  // Throws InputError if there are problems, with one line for each (at most 100) in the order of
  // the file: "FILE:LINE:COLUMN: what".  Lines and columns are counted from 1, the column in
  // characters, as editors do.  If all of them are missing files, it throws TemporaryError instead.
  void raise() const;

 private:
  struct Problem {
    TextPlace at;
    std::string what;
  };
  std::string place(TextPlace at) const;

  std::string file_;
  std::vector<std::string> lines_;
  std::vector<Problem> problems_;
  bool mistaken_ = false;  // true if one of them is no missing file
};

struct Item {
  const YAML::Node node;  // const, since assigning a YAML::Node changes the tree
  TextPlace at;           // of the value, or of its key where the value is empty
  std::string path;       // empty for the whole show
  Problems* problems;

  // Reports "PATH what" at the place of the value, and returns nothing, as whoever gives up does.
  std::nullopt_t fail(const std::string& what) const;
  // Reports in the same form a file that is missing or cannot be read.
  void miss_file(const std::string& what) const;
};

// A Range holds the bounds of a number.  A message names only the bound that is broken, with its
// unit and, for a lower bound that is not obvious, with its reason.
struct Range {
  std::string_view unit{};
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false, high_excluded = false;
  std::string_view low_reason{};

  constexpr Range above(double bound) const {
    return {unit, bound, high, true, high_excluded, low_reason};
  }
  constexpr Range at_least(double bound) const {
    return {unit, bound, high, false, high_excluded, {}};
  }
  constexpr Range below(double bound) const {
    return {unit, low, bound, low_excluded, true, low_reason};
  }
  constexpr Range at_most(double bound) const {
    return {unit, low, bound, low_excluded, false, low_reason};
  }
  constexpr Range within(double a, double b) const { return at_least(a).at_most(b); }
  constexpr Range because(std::string_view reason) const {
    return {unit, low, high, low_excluded, high_excluded, reason};
  }
};

inline constexpr Range kUnitsOfM{"units of M"};

// Converts degrees; the factor is pi/180.
inline constexpr double radians(double degrees) { return degrees * 0.017453292519943295; }

// Says what the item is, for a message: "a map", "a list", "nothing", "'3'", or "the text '3'"
// where the file has quotes.
std::string kind_of(const Item& item);

// Reads plain words, quoted text, or a number as text.  Text must not be empty, and may have no
// control characters.
std::optional<std::string> read_text(const Item& item);
// Reads text that may have several lines.  Empty lines and blanks at its ends are left out.
std::optional<std::string> read_lines(const Item& item);
std::optional<double> read_number(const Item& item, const Range& range);
// Returns the value that was read of an item, or reports that it breaks a bound.
std::optional<double> in_range(const Item& item, double value, const Range& range);
std::optional<int> read_whole_number(const Item& item, const Range& range);

// Returns the number as the file has it, for a message.
std::string as_written(const Item& item);

// Says whether the item is this word, and reports nothing, so that it can be asked before it is
// known what the item may be.
bool is_word(const Item& item, std::string_view word);
// Returns the index of the word that the item is, or reports an item that is none of them.
std::optional<std::size_t> read_choice(const Item& item, std::span<const std::string_view> words);

// Words pair the words of show files with what they stand for.
template <class T, std::size_t N>
using Words = std::array<std::pair<std::string_view, T>, N>;

template <class T, std::size_t N>
constexpr std::array<std::string_view, N> names_of(const Words<T, N>& words) {
  std::array<std::string_view, N> names;
  for (std::size_t k = 0; k < N; ++k) names[k] = words[k].first;
  return names;
}

// Returns what the item stands for if it is one of the words.  Anything else is left to another
// reader.
template <class T, std::size_t N>
std::optional<T> meaning(const Item& item, const Words<T, N>& words) {
  for (const auto& [word, value] : words)
    if (is_word(item, word)) return value;
  return std::nullopt;
}

// Reads a list of at least one entry.  The paths of its entries end in [k], counted from 1.
std::optional<std::vector<Item>> read_list(const Item& item);
// Reads a list of exactly `count` numbers.
std::optional<std::vector<double>> read_numbers(const Item& item, std::size_t count,
                                                const Range& range);

}  // namespace domefall
