// A CsvFile is a table as text, in which a row is a line, cells stand between commas, and a header
// line names the columns.  Blanks around a cell are dropped.  A cell in quotes keeps its commas and
// blanks, "" is a quote within it, and it ends on the line on which it begins.  Empty lines and
// lines that begin with '#' are passed over.  Lines end with LF or CR LF, and a byte-order mark may
// precede the first.
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
  // system fails.
  explicit CsvFile(const std::filesystem::path& file,
                   const std::vector<std::string_view>& needed = {});
  // Takes a table without a header line.  `columns` are the names, and `separator` stands for the
  // comma.
  CsvFile(const std::filesystem::path& file, char separator,
          const std::vector<std::string_view>& columns);
  CsvFile(const CsvFile&) = delete;
  CsvFile(CsvFile&&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;
  CsvFile& operator=(CsvFile&&) = delete;
  ~CsvFile() = default;

  bool has(std::string_view column) const;
  // Reads a row, which must be as long as the header.  Returns false at the end of the file.
  bool next();

  // The functions below return a cell of the row that was read last.  Those that return numbers
  // throw InputError, with the line, for a cell that holds something else.

  // The text is empty where there is no such column.
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
  bool next_line(std::string_view& line);
  void split(std::string_view line);
  std::size_t end_of_cell(std::string_view line) const;
  std::string_view unquoted(std::string_view cell);

  std::filesystem::path file_;
  std::string bytes_;
  std::string_view rest_;
  int line_number_ = 0;
  char separator_ = ',';
  std::vector<std::string> columns_;
  std::vector<std::string_view> cells_;  // into bytes_ or unquoted_
  std::deque<std::string> unquoted_;     // the row's cells that had quotes
};

}  // namespace domefall
