// Tables whose columns stand at fixed bytes of a line, as astronomers' catalogues do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/image/map_file.h"

namespace domefall {

// Bytes first to last of a line, counted from 1, both included.
struct TextColumn {
  int first, last;
};

// A number, and the range beyond which it is a mistake.
struct NumberColumn {
  int first, last;
  const char* name;
  double low, high;
};

class FixedColumns {
 public:
  // Lines have `shortest` to `longest` bytes without their ends (LF or CR LF); what is missing is blank.
  FixedColumns(const std::filesystem::path& file, std::size_t shortest, std::size_t longest);

  // False at the end.  Throws InputError, with the line, for a line that is too short or too long, and
  // for a last one that is cut short.
  bool next();

  // Of the line read last.  Text comes without the blanks around it.
  std::string_view text(const TextColumn& column) const;
  char letter(int byte) const {
    return static_cast<std::size_t>(byte) <= line_.size() ? line_[byte - 1] : ' ';
  }
  // Nothing where it is blank.  Throws InputError, with the line, for what is no number within the range.
  std::optional<double> number(const NumberColumn& column) const;
  double required(const NumberColumn& column) const;
  // Whole numbers; 0 where it is blank.
  std::uint32_t whole(const NumberColumn& column) const;

  // Throws InputError: "FILE:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  MappedFile file_;
  std::size_t shortest_, longest_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;  // of the line
};

}  // namespace domefall
