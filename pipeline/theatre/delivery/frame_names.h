// The names of delivered frames are those that IMERSA and festivals ask for, such as
// my_show_00001.png.  They are numbered from 1, and at most 10,000 lie in a folder.
#pragma once

#include <filesystem>
#include <string>

namespace domefall {

// A NamePattern is what stands before and behind a number, and how many digits the number has at
// least.
struct NamePattern {
  std::string before, after;
  int digits = 5;
};

// Reads a name whose number is a row of 1 to 10 '#', such as "my_show_#####".  Throws InputError
// unless there is one such row, for a name of more than 200 characters and for a '.' behind the
// number.  It also throws for what some system or script does not take for a plain letter.  That is
// every character but letters and digits of ASCII, '.', '_' and '-', and a '.' or '-' at the
// beginning.
NamePattern parse_name_pattern(const std::string& text);

// Returns the pattern of NAME_00001, where characters that parse_name_pattern() refuses become '_'.
// There are five digits, or as many as `count` has if that is more.
NamePattern default_name_pattern(const std::string& name, int count);

inline constexpr int kMostDeliveredInFolder = 10'000;

// DeliveredNames say where the frames of a delivery lie in it.
class DeliveredNames {
 public:
  // The extension is given without its dot.  Throws InputError if `count` has more digits than the
  // pattern, since names would no longer sort as numbers do.
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

std::string name_of_number(const NamePattern& pattern, int number);

std::string pattern_text(const NamePattern& pattern);

}  // namespace domefall
