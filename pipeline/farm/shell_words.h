// These functions write command lines as text for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// Returns a word as a POSIX shell takes it literally.  It is in single quotes where it has anything
// but letters, digits and %+,-./:=@_ .
std::string shell_word(std::string_view word);

// Returns the words, joined by blanks.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace domefall
