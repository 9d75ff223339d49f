#include "pipeline/sources/stars/catalogue_rows.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/sources/stars/raw_catalogue.h"
#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// Returns text for a message, with only the printable characters of a file that may hold anything.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c >= ' ' && c <= '~' ? c : '?';
  return out + "'";
}

}  // namespace

FixedColumns::FixedColumns(const std::filesystem::path& file, std::size_t shortest,
                           std::size_t longest)
    : file_(require_file(file)),
      shortest_(shortest),
      longest_(longest),
      rest_(without_byte_order_mark(file_.bytes())) {
  if (rest_.empty()) throw InputError(file.string() + ": the file is empty");
}

void FixedColumns::fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", file_.path().string(), line_number_, what));
}

bool FixedColumns::next() {
  if (rest_.empty()) return false;
  ++line_number_;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  // A last line without an end may have lost its tail, unless it already has every byte.
  const bool cut = end == std::string_view::npos && line_.size() < longest_;
  if (cut || line_.size() < shortest_ || line_.size() > longest_)
    fail(fmt::format("a line has {}{} bytes, this one {}{}",
                     shortest_ < longest_ ? fmt::format("{} to ", shortest_) : "", longest_,
                     line_.size(), cut ? " at the end of the file, which is cut short" : ""));
  return true;
}

std::string_view FixedColumns::text(const TextColumn& column) const {
  const std::size_t first = static_cast<std::size_t>(column.first) - 1;
  // A column beyond the end of a line that has lost its trailing blanks is blank.
  if (first >= line_.size()) return {};
  return trimmed(line_.substr(first, static_cast<std::size_t>(column.last) - first));
}

std::optional<double> FixedColumns::number(const NumberColumn& column) const {
  std::string_view cell = text({column.first, column.last});
  if (cell.empty()) return std::nullopt;
  const std::string_view whole = cell;
  // std::from_chars() takes no plus sign, but catalogues write one.  What follows must not be a
  // second sign, which from_chars() would take.
  if (cell.front() == '+' && cell.size() > 1 && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  // from_chars() also reads nan and inf, which the test of the range refuses.
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() ||
      !(value >= column.low && value <= column.high))
    fail(fmt::format("{} (bytes {}-{}) must be a number from {:.12g} to {:.12g}, got {}",
                     column.name, column.first, column.last, column.low, column.high,
                     quoted(whole)));
  return value;
}

double FixedColumns::required(const NumberColumn& column) const {
  const auto value = number(column);
  if (!value)
    fail(fmt::format("{} (bytes {}-{}) is blank", column.name, column.first, column.last));
  return *value;
}

std::uint32_t FixedColumns::whole(const NumberColumn& column) const {
  // The columns of whole numbers have ranges that a uint32 holds.
  const double value = number(column).value_or(0);
  if (value != std::floor(value)) fail(fmt::format("{} must be a whole number", column.name));
  return static_cast<std::uint32_t>(value);
}

// The end of a line is LF or CR LF, as in next().
std::size_t first_line_length(const std::filesystem::path& file) {
  // The longest of the lines that are told apart has 210 bytes.
  constexpr std::size_t kMost = 1024;
  const std::string start = start_of_unpacked(require_file(file), kMost);
  const std::string_view bytes = without_byte_order_mark(start);
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  return line.size() - (line.ends_with('\r') ? 1 : 0);
}

CatalogueStar read_star_row(const CsvFile& row, const StarColumns& c) {
  constexpr double kTurn = 360;
  CatalogueStar star;
  // Right ascension goes once around in the unit of the table, which is 24 in hours and 360 in
  // degrees.
  star.direction = sky_direction(row.required(c.ra, 0, kTurn / c.degrees) * c.degrees,
                                 row.required(c.dec, -90, 90));
  star.v = static_cast<float>(row.required(c.v, kBrightestV, kFaintestV));
  if (const auto b_v = row.number(c.b_v, c.bluest, kReddest)) star.colour = colour_of_b_v(*b_v);
  star.pm_ra = static_cast<float>(row.number(c.pm_ra, -kFastest, kFastest).value_or(0));
  star.pm_dec = static_cast<float>(row.number(c.pm_dec, -kFastest, kFastest).value_or(0));
  // A number of 0, an empty cell and a missing column all mean that the star has no number there.
  star.hip = static_cast<std::uint32_t>(row.number("hip", 0, kLastHip).value_or(0));
  const auto hd = static_cast<std::uint32_t>(row.number("hd", 0, kLastHd).value_or(0));
  // An importer that calls identify_by_hipparcos() later replaces this for the brightest star of
  // each Hipparcos number.
  if (hd) star.id = henry_draper_id(hd);
  return star;
}

}  // namespace domefall
