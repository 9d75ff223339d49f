// Everything that is wrong with a show file, gathered so that its author mends it in one go.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// A place in the text, counted from 0 as yaml-cpp does; the column in bytes.
struct TextPlace {
  int line = 0, column = 0;
};

class Problems {
 public:
  // `file` as the user named it; `text` is its content.
  Problems(std::string file, std::string text);

  void add(TextPlace at, const std::string& what);

  std::size_t count() const { return problems_.size(); }

  // Throws InputError with one line for each problem, in the order of the file:
  // "FILE:LINE:COLUMN: what", counted from 1 and the column in characters, as editors do.
  // Does nothing if there is none.
  void raise() const;

 private:
  struct Problem {
    TextPlace at;
    std::string what;
  };
  std::string place(TextPlace at) const;

  std::string file_;
  std::vector<std::string> lines_;
  std::vector<Problem> problems_;
};

// A piece of the user's text for a message: on one line, without control characters, cut after 40
// characters.
std::string shown(std::string_view text);

}  // namespace domefall
