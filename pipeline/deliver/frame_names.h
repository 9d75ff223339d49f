// The names of delivered frames are those that IMERSA and festivals ask for, such as
// my_show_00001.png.  They are numbered from 1, and at most 10,000 lie in a folder.
#pragma once

#include <filesystem>
#include <string>

namespace domefall {

// A NamePattern is what stands before and behind a number, which has a least number of digits.
struct NamePattern {
  std::string before, after;
  int digits = 5;
};

// Reads a name whose number is a row of 1 to 10 '#', such as "my_show_#####".  Throws InputError
// for another number of rows, and for what some system or script takes for more than a letter.
// That is all but letters and digits of ASCII, '.', '_' and '-', and a name that begins with '.' or
// '-'.
NamePattern parse_name_pattern(const std::string& text);

// Returns NAME_00001, where characters that parse_name_pattern() refuses become '_'.  There are
// five digits, or as many as `count` has.
NamePattern default_name_pattern(const std::string& name, int count);

inline constexpr int kMostDeliveredInFolder = 10'000;

// DeliveredNames say where the frames of a delivery lie in it.
class DeliveredNames {
 public:
  // The kind is an extension without its dot.  Throws InputError if `count` has more digits than
  // the pattern, since names would no longer sort as numbers do.
  DeliveredNames(NamePattern pattern, int count, std::string extension);

  // Returns the path of frame `index`, from 0, which has the number index + 1, as
  // "frames/NAME_00001.png".  If there are more than kMostDeliveredInFolder, it is
  // "frames/NAME_00001_10000/NAME_00001.png".
  std::filesystem::path path(int index) const;

  const NamePattern& pattern() const { return pattern_; }
  const std::string& extension() const { return extension_; }
  int count() const { return count_; }

 private:
  NamePattern pattern_;
  int count_;
  std::string extension_;
};

// Returns the name of a number in a pattern.
std::string name_of_number(const NamePattern& pattern, int number);

// Returns the pattern as parse_name_pattern() reads it.
std::string pattern_text(const NamePattern& pattern);

}  // namespace domefall
