#include "pipeline/sky/catalogue/import/quoted_table.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "pipeline/image/errors.h"

namespace domefall {

QuotedTable::QuotedTable(const std::filesystem::path& file,
                         const std::vector<std::string_view>& needed, char separator,
                         const std::vector<std::string_view>& columns)
    : file_(file),
      separator_(separator),
      rest_(file_.bytes()),
      columns_(columns.begin(), columns.end()) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  if (!columns_.empty()) return;
  std::string_view header;
  if (!next_line(header)) throw InputError(file.string() + ": the file is empty");
  columns_ = cells_of(header);
  for (const std::string_view column : needed)
    if (std::find(columns_.begin(), columns_.end(), column) == columns_.end())
      fail("the table has no column " + std::string(column));
}

void QuotedTable::fail(const std::string& what) const {
  throw InputError(file_.path().string() + ":" + std::to_string(number_) + ": " + what);
}

bool QuotedTable::next_line(std::string_view& line) {
  while (!rest_.empty()) {
    ++number_;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty() && line[0] != '#') return true;
  }
  return false;
}

std::vector<std::string> QuotedTable::cells_of(std::string_view line) const {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool doubled = quoted && line.substr(i, 2) == "\"\"";
    if (doubled)
      cells.back() += line[i++];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == separator_ && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  }
  if (quoted) fail("a quote is left open");
  return cells;
}

bool QuotedTable::next() {
  std::string_view line;
  if (!next_line(line)) return false;
  cells_ = cells_of(line);
  if (cells_.size() != columns_.size())
    fail("expected " + std::to_string(columns_.size()) + " columns, got " +
         std::to_string(cells_.size()));
  return true;
}

std::string_view QuotedTable::text(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  return found == columns_.end() ? std::string_view()
                                 : cells_[static_cast<std::size_t>(found - columns_.begin())];
}

std::optional<double> QuotedTable::number(std::string_view column, double low, double high) const {
  const std::string_view cell = text(column);
  if (cell.empty()) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error == std::errc() && end == cell.data() + cell.size() && value >= low && value <= high)
    return value;
  char range[64];
  std::snprintf(range, sizeof range, "%.12g to %.12g", low, high);
  fail(std::string(column) + " must be a number from " + range + ", got '" + std::string(cell) +
       "'");
}

double QuotedTable::required(std::string_view column, double low, double high) const {
  const auto value = number(column, low, high);
  if (!value) fail(std::string(column) + " is empty");
  return *value;
}

}  // namespace domefall
