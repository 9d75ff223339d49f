// Tables separated by commas (or tabs) with a header line and, perhaps, quotes around their cells ("" for a quote within).
// A cell does not run over a line's end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/image/map_file.h"

namespace domefall {

class QuotedTable {
 public:
  // Throws InputError where there is no header, or it lacks one of the `needed` columns.  Where `columns` are
  // given the file has no header.
  QuotedTable(const std::filesystem::path& file, const std::vector<std::string_view>& needed,
              char separator = ',', const std::vector<std::string_view>& columns = {});

  // False at the end.  Throws InputError, with the line, for a row not as long as the header or with a quote
  // left open.
  bool next();
  // Of the row read last; empty where there is no such column.
  std::string_view text(std::string_view column) const;
  // Nothing where it is empty.  Throws InputError, with the line, for what is no number in the range.
  std::optional<double> number(std::string_view column, double low, double high) const;
  double required(std::string_view column, double low, double high) const;

  // Throws InputError: "FILE:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool next_line(std::string_view& line);
  std::vector<std::string> cells_of(std::string_view line) const;

  MappedFile file_;
  char separator_;
  std::string_view rest_;
  std::size_t number_ = 0;  // of the line
  std::vector<std::string> columns_, cells_;
};

}  // namespace domefall
