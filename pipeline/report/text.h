// These functions write numbers, lines of tables and file names as the report needs them.
#pragma once

#include <fmt/format.h>

#include <cctype>
#include <string>
#include <type_traits>

namespace domefall {

// Returns the value with three significant digits if it is below 100, else rounded to an integer.
inline std::string amount(double value) {
  constexpr double kWhole = 100;
  return value < kWhole ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

// Returns an error with two significant digits, which show its power of ten and a little more.
inline std::string error_text(double value) { return fmt::format("{:.1e}", value); }

// Returns the tolerance of a step, or nothing for 0, which says that there is none.
inline std::string tolerance_text(double value) {
  return value > 0 ? fmt::format("{:.0e}", value) : "";
}

// Returns line(row) of all rows.
template <class Rows, class Line>
std::string lines_of(const Rows& rows, const Line& line) {
  std::string lines;
  for (const auto& row : rows) lines += line(row);
  return lines;
}

// Returns a line of a table in Markdown.
template <class... Cells>
std::string table_line(const Cells&... cells) {
  std::string line = "|";
  ((line += fmt::format(" {} |", cells)), ...);
  return line + "\n";
}

// Returns a cell of a CSV file.  Numbers have six significant digits, so that a file shows more
// than the pages do.  A text that holds a comma, a quotation mark or a new line is quoted as RFC
// 4180 prescribes.
template <class Value>
std::string csv_cell(const Value& value) {
  if constexpr (std::is_same_v<Value, double>) return fmt::format("{:.6g}", value);
  std::string text = fmt::format("{:}", value);
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

template <class... Cells>
std::string csv_line(const Cells&... cells) {
  std::string line;
  ((line += csv_cell(cells) + ","), ...);
  line.back() = '\n';
  return line;
}

// Makes a name fit for a file: letters become small, and whatever else stands between letters and
// digits becomes one hyphen.  "Circular, 10 M" becomes "circular-10-m".
inline std::string slug(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out;
}

}  // namespace domefall
