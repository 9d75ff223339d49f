#include "pipeline/image/csv_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "pipeline/image/byte_order_mark.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {
namespace {

// A catalogue of 10^7 stars has 1 GiB.
constexpr std::uint64_t kLargestTable = std::uint64_t{4} << 30;

std::string contents_of(const std::filesystem::path& file) {
  std::string bytes = read_file(require_file(file), kLargestTable);
  if (bytes.empty()) throw InputError(file.string() + ": the file is empty");
  return bytes;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? "" : text.substr(first, last - first + 1);
}

std::optional<double> number_of(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, const std::vector<std::string_view>& needed)
    : file_(file), bytes_(contents_of(file)), rest_(without_byte_order_mark(bytes_)) {
  std::string_view header;
  if (!next_line(header)) fail("the table has no header line");
  split(header);
  columns_.assign(cells_.begin(), cells_.end());
  for (const std::string_view column : needed)
    if (!has(column)) fail(fmt::format("the table has no column {}", column));
}

CsvFile::CsvFile(const std::filesystem::path& file, char separator,
                 const std::vector<std::string_view>& columns)
    : file_(file),
      bytes_(contents_of(file)),
      rest_(without_byte_order_mark(bytes_)),
      separator_(separator),
      columns_(columns.begin(), columns.end()) {}

void CsvFile::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", file_.string(), line_number_, what));
}

bool CsvFile::next_line(std::string_view& line) {
  while (!rest_.empty()) {
    ++line_number_;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first != std::string_view::npos && line[first] != '#') return true;
  }
  return false;
}

// Returns the length of the line's first cell.  Two quotes that stand for one close the quoted part
// and open it again, so they need no case of their own.
std::size_t CsvFile::end_of_cell(std::string_view line) const {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == separator_ && !quoted) return i;
  }
  if (quoted) fail("a quote is left open");
  return line.size();
}

std::string_view CsvFile::unquoted(std::string_view cell) {
  if (cell.find('"') == std::string_view::npos) return cell;
  std::string& plain = unquoted_.emplace_back();
  bool quoted = false;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const bool doubled = quoted && cell.substr(i, 2) == "\"\"";
    if (cell[i] != '"' || doubled) plain += cell[i];
    if (doubled)
      ++i;
    else if (cell[i] == '"')
      quoted = !quoted;
  }
  return plain;
}

void CsvFile::split(std::string_view line) {
  cells_.clear();
  unquoted_.clear();
  for (;;) {
    const std::size_t end = end_of_cell(line);
    cells_.push_back(unquoted(trimmed(line.substr(0, end))));
    if (end == line.size()) return;
    line.remove_prefix(end + 1);
  }
}

bool CsvFile::next() {
  std::string_view line;
  if (!next_line(line)) return false;
  split(line);
  if (cells_.size() != columns_.size())
    fail(fmt::format("expected {} columns, got {}", columns_.size(), cells_.size()));
  return true;
}

bool CsvFile::has(std::string_view column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::string_view CsvFile::text(std::string_view column) const {
  const auto at = std::find(columns_.begin(), columns_.end(), column);
  return at == columns_.end() ? "" : cells_[static_cast<std::size_t>(at - columns_.begin())];
}

double CsvFile::number(std::string_view column) const {
  const std::string_view cell = text(column);
  const auto value = number_of(cell);
  if (!value || !std::isfinite(*value))
    fail(fmt::format("{} must be a finite number, got '{}'", column, cell));
  return *value;
}

std::optional<double> CsvFile::number(std::string_view column, double low, double high) const {
  const std::string_view cell = text(column);
  if (cell.empty()) return std::nullopt;
  const auto value = number_of(cell);
  if (!value || !(*value >= low && *value <= high))
    fail(fmt::format("{} must be a number from {:.12g} to {:.12g}, got '{}'", column, low, high,
                     cell));
  return value;
}

double CsvFile::required(std::string_view column, double low, double high) const {
  const auto value = number(column, low, high);
  if (!value) fail(fmt::format("{} is empty", column));
  return *value;
}

}  // namespace domefall
