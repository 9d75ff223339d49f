#include "pipeline/image/csv_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

// Spreadsheets put it before what they save as UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file) : file_(file), in_(file) {
  if (!in_) throw InputError(file.string() + ": the table cannot be read");
  if (!next_line()) fail("the table has no header line");
  if (line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
  for (const std::string_view cell : cells_of(line_)) columns_.emplace_back(cell);
}

bool CsvFile::next_line() {
  while (std::getline(in_, line_)) {
    ++number_;
    if (!line_.empty() && line_.back() == '\r') line_.pop_back();
    if (!line_.empty() && line_[0] != '#') return true;
  }
  if (in_.bad()) fail("reading stopped");
  return false;
}

bool CsvFile::next() {
  if (!next_line()) return false;
  cells_ = cells_of(line_);
  if (cells_.size() != columns_.size())
    fail("expected " + std::to_string(columns_.size()) + " columns, got " +
         std::to_string(cells_.size()));
  return true;
}

std::size_t CsvFile::find(std::string_view column) const {
  return static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) -
                                  columns_.begin());
}

bool CsvFile::has(std::string_view column) const { return find(column) < columns_.size(); }

std::string_view CsvFile::text(std::string_view column) const {
  const std::size_t at = find(column);
  if (at == columns_.size()) fail("the table has no column " + std::string(column));
  return cells_[at];
}

double CsvFile::number(std::string_view column) const {
  const std::string_view cell = text(column);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    fail(std::string(column) + " must be a finite number, got '" + std::string(cell) + "'");
  return value;
}

void CsvFile::fail(const std::string& what) const {
  throw InputError(file_.string() + ":" + std::to_string(number_) + ": " + what);
}

}  // namespace domefall
