// Tables as text: comma-separated, a header line, '#' lines are comments, no quotes.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

class CsvFile {
 public:
  // Reads the header.  Throws InputError if there is none or the file cannot be read.
  explicit CsvFile(const std::filesystem::path& file);

  bool has(std::string_view column) const;
  // False at the end.  Throws InputError, with the line, of a row that is not as long as the header.
  bool next();
  // Of the row read last.  number() throws InputError, with the line, of what is no finite number or
  // where there is no such column.
  std::string_view text(std::string_view column) const;
  double number(std::string_view column) const;

  // Throws InputError: "FILE:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool next_line();
  std::size_t find(std::string_view column) const;

  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  int number_ = 0;  // of the line
  std::vector<std::string> columns_;
  std::vector<std::string_view> cells_;  // into line_
};

}  // namespace domefall
