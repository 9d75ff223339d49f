// These functions write numbers, table cells and file names as the report needs them.
#pragma once

#include <fmt/core.h>

#include <cctype>
#include <string>

namespace domefall {

// Returns the value with three significant digits if it is below 100, else rounded to an integer.
inline std::string amount(double value) {
  constexpr double kWhole = 100;
  return value < kWhole ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

// Returns a cell of a CSV file.  A cell that holds a comma, a quotation mark or a new line is
// quoted as RFC 4180 prescribes.
inline std::string csv_cell(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
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
