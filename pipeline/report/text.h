// Small pieces of text that the report is made of.
#pragma once

#include <array>
#include <cctype>
#include <cstdio>
#include <string>

namespace domefall {

// printf of one number.
inline std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);  // NOLINT(*-vararg)
  return text.data();
}

// Three digits, or all those before the point.
inline std::string amount(double value) {
  constexpr double kWhole = 100;
  return formatted(value < kWhole ? "%.3g" : "%.0f", value);
}

// Quoted where a comma or a quotation mark asks for it (RFC 4180).
inline std::string csv_cell(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// "Circular, 10 M" -> "circular-10-m": part of a file's name.
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
