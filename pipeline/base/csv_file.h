// A CsvFile is a table as text, in which a row is a line and a header line names the columns.
// docs/stars.md#tables states its rules, which are meant for tables as spreadsheets, databases and
// VizieR write them.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

class CsvFile {
 public:
  // Reads the whole file and its header.  Throws InputError where the file cannot be read, is empty
  // or larger than 4 GiB, or has no column of a name in `needed`, and TemporaryError where the
  // system fails.  Columns are asked for in lower case, and the file may have them in any.
  // A part of a table of which `first` is the first one may go on without a header line.
  explicit CsvFile(const std::filesystem::path& file,
                   const std::vector<std::string_view>& needed = {},
                   const CsvFile* first = nullptr);
  // Takes a table without a header line.  `columns` are the names, and `separator` stands for the
  // comma.
  CsvFile(const std::filesystem::path& file, char separator,
          const std::vector<std::string_view>& columns);
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  ~CsvFile() = default;

  // The names of the columns, in lower case.
  const std::vector<std::string>& columns() const { return columns_; }
  bool has(std::string_view column) const;
  // The same in these cases of letters: k is not K.
  bool has_as_written(std::string_view column) const;
  // Reads a row, which must be as long as the header.  Returns false at the end of the file.
  bool next();

  // The functions below return a cell of the row that was read last.  Those that return numbers
  // throw InputError, with the line, for a cell that holds something else.

  // The text is empty where there is no such column, and for "null", "NaN", "--" and the like.
  std::string_view text(std::string_view column) const;
  // The number is finite.
  double number(std::string_view column) const;
  // The number is from `low` to `high`.  Nothing is returned where the cell is empty or there is no
  // such column.
  std::optional<double> number(std::string_view column, double low, double high) const;
  // This is the same for a cell that may not be empty.
  double required(std::string_view column, double low, double high) const;

  // Throws InputError with the message "FILE:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void read_header(const std::vector<std::string_view>& needed, const CsvFile* first);
  std::string read_names(char separator);
  bool has_all(const std::vector<std::string_view>& needed) const;
  [[noreturn]] void fail_columns(const std::vector<std::string_view>& needed) const;
  bool find_row();
  void skip_line();
  void end_line();
  std::string split();
  bool take_quoted();
  bool is_header() const;
  bool is_below_header() const;
  std::string_view cell(std::string_view column) const;
  std::optional<double> value_of(std::string_view cell) const;

  std::filesystem::path file_;
  std::string bytes_;
  std::string_view rest_;
  int line_number_ = 0, row_line_ = 0;  // lines that were read; the first one of the row
  char separator_ = ',';
  mutable char decimal_sign_ = 0;        // of the numbers so far
  bool below_header_ = false;            // units and a rule may follow
  std::vector<std::string> columns_;     // in lower case
  std::vector<std::string> written_;     // as in the header
  std::vector<std::string_view> cells_;  // into bytes_ or unquoted_
  std::deque<std::string> unquoted_;     // the row's cells that differ from its bytes
};

}  // namespace domefall
