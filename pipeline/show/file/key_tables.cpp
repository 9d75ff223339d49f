// Reads the rows of keys.cpp.
#include <charconv>
#include <map>
#include <stdexcept>

#include "pipeline/show/file/keys.h"

namespace domefall {
namespace {

// Takes the names of a row's first cell, and gives each the other two.
void add_row(std::string_view row, std::vector<Key>& keys) {
  const std::size_t first = row.find(" | "), last = row.rfind(" |", row.size() - 3);
  const std::string_view value = row.substr(first + 3, last - first - 3);
  const std::string_view fallback = row.substr(last + 3, row.size() - last - 5);
  std::string_view names = row.substr(0, first);
  for (std::size_t at = names.find('`'); at != std::string_view::npos; at = names.find('`')) {
    names.remove_prefix(at + 1);
    keys.push_back({names.substr(0, names.find('`')), value, fallback});
    names.remove_prefix(names.find('`') + 1);
  }
}

std::map<std::string_view, std::vector<Key>> read_tables() {
  std::map<std::string_view, std::vector<Key>> tables;
  std::vector<Key>* table = nullptr;
  for (std::string_view rest = rows_of_keys(); !rest.empty();
       rest.remove_prefix(rest.find('\n') + 1)) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.starts_with("## "))
      table = &tables[line.substr(3)];
    else if (!line.empty())
      add_row(line, *table);
  }
  return tables;
}

std::optional<double> take(std::string_view& text, std::string_view words) {
  if (!text.starts_with(words)) return std::nullopt;
  double number = 0;
  const char* begin = text.data() + words.size();
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

std::string_view unit_of(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kUnits[] = {{"_deg", "degrees"},
                                                                      {"_s", "seconds"},
                                                                      {"_k", "kelvin"},
                                                                      {"_m", "units of M"},
                                                                      {"_r", "units of M"}};
  for (const auto& [end, unit] : kUnits)
    if (name.ends_with(end) || name == end.substr(1)) return unit;
  return {};
}

}  // namespace

Range Key::range() const {
  std::string_view rest = value.substr(0, value.find(':'));
  Range range;
  if (const auto above = take(rest, "above "))
    range = range.above(*above);
  else if (const auto least = take(rest, rest.starts_with("at least ") ? "at least " : ""))
    range = range.at_least(*least);
  else
    throw std::logic_error("the key " + std::string(name) + " has no range");
  if (const auto below = take(rest, rest.starts_with(", below ") ? ", below " : " to below "))
    range = range.below(*below);
  else if (const auto most = take(rest, rest.starts_with(", at most ") ? ", at most " : " to "))
    range = range.at_most(*most);
  if (rest.starts_with(' ')) rest.remove_prefix(1);
  range.unit = rest.empty() ? unit_of(name) : rest == "M" ? "units of M" : rest;
  return range;
}

std::vector<std::string_view> Key::words() const {
  std::vector<std::string_view> words;
  const std::string_view all = value.substr(0, value.find(':'));
  for (std::size_t at = all.find('`'); at != std::string_view::npos;) {
    const std::size_t end = all.find('`', at + 1);
    words.push_back(all.substr(at + 1, end - at - 1));
    at = all.find('`', end + 1);
  }
  return words;
}

std::string_view Key::word() const {
  const std::size_t at = fallback.starts_with("[`") ? 2 : fallback.size();
  return fallback.substr(at, fallback.find('`', at) - at);
}

double Key::number() const {
  std::string_view text = fallback;
  if (const auto number = take(text, "[")) return *number;
  throw std::logic_error("the key " + std::string(name) + " has no number as its default");
}

const std::vector<Key>& keys_of(std::string_view table) {
  static const auto tables = read_tables();
  return tables.at(table);
}

}  // namespace domefall
