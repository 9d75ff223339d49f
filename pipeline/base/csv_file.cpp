#include "pipeline/base/csv_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

// A catalogue of 10^7 stars has 1 GiB.
constexpr std::uint64_t kLargestTable = std::uint64_t{4} << 30;

// A header is tried with each of these, in this order.
constexpr std::string_view kSeparators = ",\t;|";

// Cells with these words hold nothing, in any case.
constexpr std::array<std::string_view, 7> kNothing{"null", "nan", "na", "n/a", "--", "-", "~"};

// A row below the header with one of these, in any case, is one of units.
constexpr std::array<std::string_view, 31> kUnits{
    "deg",    "degree", "degrees", "\xC2\xB0", "rad",      "radian", "radians",  "h",
    "hr",     "hour",   "hours",   "h:m:s",    "d:m:s",    "mag",    "mags",     "magnitude",
    "mas",    "mas/yr", "mas/y",   "mas/year", "mas yr-1", "mas/a",  "mas.yr-1", "arcsec",
    "arcmin", "s",      "sec",     "seconds",  "m",        "pc",     "km/s"};

std::string contents_of(const std::filesystem::path& file) {
  std::string bytes = read_file(require_file(file), kLargestTable);
  if (bytes.empty()) throw InputError(file.string() + ": the file is empty");
  if (is_gzip(bytes)) bytes = unpacked(bytes, file);
  return as_utf8(std::move(bytes), file);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? "" : text.substr(first, last - first + 1);
}

// The longest of the words has four letters, and most cells are looked at by their length alone.
bool is_nothing(std::string_view cell) {
  if (cell.size() > 4) return false;
  return cell.empty() || std::ranges::find(kNothing, in_lower_case(cell)) != kNothing.end();
}

bool is_unit(std::string_view cell) {
  const std::size_t first = cell.find_first_not_of("([\""), last = cell.find_last_not_of(")]\"");
  if (first == std::string_view::npos || last == std::string_view::npos) return false;
  return std::ranges::find(kUnits, in_lower_case(cell.substr(first, last - first + 1))) !=
         kUnits.end();
}

// A line may be ruled off by dashes and what stands between them.
bool is_rule(std::string_view cell) {
  return cell.find_first_not_of("-=_+: ") == std::string_view::npos;
}
bool has_dashes(std::string_view cell) {
  return cell.find("--") != std::string_view::npos || cell.find("==") != std::string_view::npos;
}

int line_ends_in(std::string_view text) {
  int count = 0;
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text[k] == '\n' || (text[k] == '\r' && text.substr(k, 2) != "\r\n")) ++count;
  return count;
}

std::string with_blanks(std::string_view text) {
  std::string line;
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text.substr(k, 2) != "\r\n") line += text[k] == '\r' || text[k] == '\n' ? ' ' : text[k];
  return line;
}

// Returns the number of a cell, which may have a plus sign and a decimal comma.
std::optional<double> number_of(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  std::string pointed;
  if (const std::size_t comma = cell.find(','); comma != std::string_view::npos) {
    if (cell.find('.') != std::string_view::npos) return std::nullopt;
    pointed = cell;
    pointed[comma] = '.';
    cell = pointed;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

// Returns a cell for a message, with what cannot be seen in it.
std::string got(std::string_view cell) {
  const std::string odd = odd_character(cell);
  return fmt::format("got '{}'{}{}", spell_bad_bytes(cell.substr(0, 80)),
                     odd.empty() ? "" : ", which ", odd);
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, const std::vector<std::string_view>& needed,
                 const CsvFile* first)
    : file_(file), bytes_(contents_of(file)), rest_(bytes_) {
  read_header(needed, first);
}

CsvFile::CsvFile(const std::filesystem::path& file, char separator,
                 const std::vector<std::string_view>& columns)
    : file_(file),
      bytes_(contents_of(file)),
      rest_(bytes_),
      separator_(separator),
      columns_(columns.begin(), columns.end()) {}

void CsvFile::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", file_.string(), row_line_, what));
}

// Finds the separator by which the header has the columns that are needed, or else the most.
void CsvFile::read_header(const std::vector<std::string_view>& needed, const CsvFile* first) {
  // Excel tells itself the separator in a line "sep=;", which is found without it.
  if (in_lower_case(rest_.substr(0, 4)) == "sep=") skip_line();
  if (!find_row()) fail("the table has no header line");
  const std::string_view header = rest_;
  const int line = line_number_;
  std::pair<bool, std::size_t> most;
  char best = 0;
  for (const char separator : kSeparators) {
    rest_ = header, line_number_ = line;
    read_names(separator);
    const std::pair columns(has_all(needed), columns_.size());
    if (best == 0 || columns > most) most = columns, best = separator;
  }
  rest_ = header, line_number_ = line;
  if (const std::string complaint = read_names(best); !complaint.empty()) fail(complaint);
  if (has_all(needed)) return;
  if (!first) fail_columns(needed);
  rest_ = header, line_number_ = line;
  separator_ = first->separator_;
  columns_ = first->columns_;
  written_ = first->written_;
}

std::string CsvFile::read_names(char separator) {
  separator_ = separator;
  std::string complaint = split();
  columns_.clear();
  written_.assign(cells_.begin(), cells_.end());
  for (const std::string_view name : cells_) columns_.push_back(in_lower_case(name));
  below_header_ = true;
  return complaint;
}

bool CsvFile::has_all(const std::vector<std::string_view>& needed) const {
  return std::ranges::all_of(needed, [&](std::string_view column) { return has(column); });
}

void CsvFile::fail_columns(const std::vector<std::string_view>& needed) const {
  const auto missing =
      std::ranges::find_if(needed, [&](std::string_view column) { return !has(column); });
  std::string what = fmt::format("the table has no column {}", *missing);
  for (const std::string& column : columns_)
    if (const std::string odd = odd_character(column); !odd.empty())
      fail(fmt::format("{}; its column '{}' {}", what, spell_bad_bytes(column), odd));
  if (number_of(columns_.front()))
    what += "; its first line has numbers, so name the part with the header line before it";
  fail(what);
}

// Moves to the next line that is neither empty nor a comment.
bool CsvFile::find_row() {
  while (!rest_.empty()) {
    row_line_ = line_number_ + 1;
    const std::size_t first = rest_.find_first_not_of(" \t");
    if (first != std::string_view::npos && rest_[first] != '#' && rest_[first] != '\n' &&
        rest_[first] != '\r')
      return true;
    skip_line();
  }
  row_line_ = line_number_;
  return false;
}

void CsvFile::skip_line() {
  const std::size_t end = rest_.find_first_of("\r\n");
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
  end_line();
}

// Passes the end of a line, which is LF, CR LF or CR, or that of the file.
void CsvFile::end_line() {
  ++line_number_;
  rest_.remove_prefix(std::min<std::size_t>(rest_.size(), rest_.starts_with("\r\n") ? 2 : 1));
}

// Takes the cells of a row and its end.  Returns what is wrong with them, or an empty text.
std::string CsvFile::split() {
  cells_.clear();
  unquoted_.clear();
  for (;;) {
    const std::string_view blanks = separator_ == '\t' ? " " : " \t";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    if (rest_.starts_with('"')) {
      if (!take_quoted()) return "a quote is left open";
    } else {
      const auto ends = [&](char c) { return c == separator_ || c == '\n' || c == '\r'; };
      const auto end = static_cast<std::size_t>(std::ranges::find_if(rest_, ends) - rest_.begin());
      cells_.push_back(trimmed(rest_.substr(0, end)));
      rest_.remove_prefix(end);
    }
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    if (rest_.empty() || rest_[0] == '\r' || rest_[0] == '\n') break;
    if (rest_[0] != separator_) {
      skip_line();
      return "text follows the quote that ends a cell";
    }
    rest_.remove_prefix(1);
  }
  end_line();
  return "";
}

// Takes a cell in quotes, in which two quotes stand for one, and the end of a line for a blank.
// Returns false if no quote ends it.
bool CsvFile::take_quoted() {
  rest_.remove_prefix(1);
  const std::string_view begin = rest_;
  std::string plain;
  for (bool doubled = true; doubled;) {
    const std::size_t quote = rest_.find('"');
    if (quote == std::string_view::npos) {
      rest_ = {};
      return false;
    }
    plain += rest_.substr(0, quote);
    rest_.remove_prefix(quote + 1);
    doubled = rest_.starts_with('"');
    if (doubled) plain += '"', rest_.remove_prefix(1);
  }
  line_number_ += line_ends_in(plain);
  // Most cells need no copy.
  if (begin.starts_with(plain) && plain.find_first_of("\r\n") == std::string::npos)
    cells_.push_back(begin.substr(0, plain.size()));
  else
    cells_.push_back(unquoted_.emplace_back(with_blanks(plain)));
  return true;
}

// Says whether the row that was split last is one of units, or a rule.
bool CsvFile::is_below_header() const {
  if (std::ranges::all_of(cells_, is_rule) && std::ranges::any_of(cells_, has_dashes)) return true;
  return std::ranges::any_of(cells_, is_unit) &&
         std::ranges::none_of(cells_, [](std::string_view cell) { return !!number_of(cell); });
}

bool CsvFile::is_header() const {
  return std::ranges::equal(cells_, columns_, [](std::string_view cell, std::string_view column) {
    return cell.size() == column.size() && in_lower_case(cell) == column;
  });
}

bool CsvFile::next() {
  while (find_row()) {
    if (const std::string complaint = split(); !complaint.empty()) fail(complaint);
    // Spreadsheets end a table with rows of empty cells.
    if (std::ranges::all_of(cells_, [](std::string_view cell) { return cell.empty(); })) continue;
    if (is_header()) {  // of a part that was appended
      below_header_ = true;
      continue;
    }
    if (below_header_ && is_below_header()) continue;
    below_header_ = false;
    if (cells_.size() != columns_.size())
      fail(fmt::format("expected {} columns, got {}", columns_.size(), cells_.size()));
    return true;
  }
  return false;
}

bool CsvFile::has(std::string_view column) const {
  return std::ranges::find(columns_, column) != columns_.end();
}

std::string_view CsvFile::cell(std::string_view column) const {
  const auto at = std::ranges::find(columns_, column);
  return at == columns_.end() ? "" : cells_[static_cast<std::size_t>(at - columns_.begin())];
}

bool CsvFile::has_as_written(std::string_view column) const {
  return std::ranges::find(written_, column) != written_.end();
}

std::string_view CsvFile::text(std::string_view column) const {
  const std::string_view text = cell(column);
  return is_nothing(text) ? "" : text;
}

// Returns the number of a cell.  A table keeps to one decimal sign, so that "1,234" is not taken
// for 1.234 where a comma parts thousands.
std::optional<double> CsvFile::value_of(std::string_view cell) const {
  const auto value = number_of(cell);
  const std::size_t at = value ? cell.find_first_of(".,") : std::string_view::npos;
  if (at == std::string_view::npos) return value;
  if (decimal_sign_ == 0) decimal_sign_ = cell[at];
  if (cell[at] != decimal_sign_)
    fail(fmt::format("'{}' has a decimal {}, and the numbers before it have a decimal {}", cell,
                     cell[at] == ',' ? "comma" : "point", cell[at] == ',' ? "point" : "comma"));
  return value;
}

double CsvFile::number(std::string_view column) const {
  const auto value = value_of(cell(column));
  if (!value || !std::isfinite(*value))
    fail(fmt::format("{} must be a finite number, {}", column, got(cell(column))));
  return *value;
}

std::optional<double> CsvFile::number(std::string_view column, double low, double high) const {
  const std::string_view written = text(column);
  if (written.empty()) return std::nullopt;
  const auto value = value_of(written);
  if (!value || !(*value >= low && *value <= high))
    fail(fmt::format("{} must be a number from {:.12g} to {:.12g}, {}", column, low, high,
                     got(written)));
  return value;
}

double CsvFile::required(std::string_view column, double low, double high) const {
  const auto value = number(column, low, high);
  if (!value) fail(fmt::format("{} is empty", column));
  return *value;
}

}  // namespace domefall
