// Problems gathers the mistakes in a show file, so that its author can mend all of them at once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// A TextPlace is counted from 0 as yaml-cpp does, with the column in bytes.
struct TextPlace {
  int line = 0, column = 0;
};

class Problems {
 public:
  // `file` is the name that the user gave, and `text` the file's content.
  Problems(std::string file, std::string text);

  // Adds a mistake of the show's author.
  void add(TextPlace at, const std::string& what);
  // Adds a file that is missing or cannot be read, though another machine may have it.
  void add_missing_file(TextPlace at, const std::string& what);

  std::size_t count() const { return problems_.size(); }

  // Throws InputError if there are problems, with one line for each (at most 100) in the order of
  // the file: "FILE:LINE:COLUMN: what".  Lines and columns are counted from 1, the column in
  // characters, as editors do.  If all of them are missing files, it throws TemporaryError instead.
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
  bool mistaken_ = false;  // true if one of them is no missing file
};

// Returns a piece of the user's text for a message.  It is cut after 40 characters, and control
// characters become blanks.
std::string shown(std::string_view text);

}  // namespace domefall
