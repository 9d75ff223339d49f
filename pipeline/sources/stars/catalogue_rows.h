// Rows of catalogues: columns at fixed bytes of a line, as astronomers' tables often have, and
// columns with names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/unpacked_file.h"
#include "pipeline/sources/stars/raw_catalogue.h"

namespace domefall {

// A column takes the bytes `first` to `last` of a line, counted from 1 and both included.
struct TextColumn {
  int first, last;
};

// A number of this column is a mistake if it lies outside `low` to `high`.
struct NumberColumn {
  int first, last;
  const char* name;
  double low, high;
};

class FixedColumns {
 public:
  // Lines have `shortest` to `longest` bytes without their ends (LF or CR LF).  A line that is
  // shorter than `longest` counts as filled up with blanks.  Throws InputError for an empty file,
  // and as UnpackedFile does.
  FixedColumns(const std::filesystem::path& file, std::size_t shortest, std::size_t longest);

  // Reads a line and says whether there was one.  Throws InputError, with the line, if it is too
  // short or too long, or is a last line that is cut short.
  bool next();

  // The functions below look at the line that was read last.

  // Returns the text without the blanks around it.
  std::string_view text(const TextColumn& column) const;
  char letter(int byte) const {
    return static_cast<std::size_t>(byte) <= line_.size() ? line_[byte - 1] : ' ';
  }
  // Returns the number, or nothing where the column is blank.  Throws InputError, with the line,
  // for text that is no number within the column's range.
  std::optional<double> number(const NumberColumn& column) const;
  // Returns the number, but throws InputError where the column is blank.
  double required(const NumberColumn& column) const;
  // Returns a whole number, or 0 where the column is blank.
  std::uint32_t whole(const NumberColumn& column) const;

  // Throws InputError: "FILE:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  UnpackedFile file_;
  std::size_t shortest_, longest_;
  std::string_view rest_, line_;
  std::size_t line_number_ = 0;
};

// Returns the length of a file's first line without its end.  Throws as UnpackedFile does.
std::size_t first_line_length(const std::filesystem::path& file);

struct StarColumns {
  std::string_view ra, dec, v, b_v, pm_ra, pm_dec;  // their names in the table
  double degrees;                                   // in one unit of `ra`
  double bluest;                                    // the least B-V that is taken as a number
};

// Returns the star of the row read last.  Columns `hip` and `hd` identify it where the table has
// them.  Throws InputError with the line.
CatalogueStar read_star_row(const CsvFile& row, const StarColumns& columns);

}  // namespace domefall
