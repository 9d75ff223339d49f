// Command lines as text for a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// A word as a POSIX shell takes it literally: in single quotes where it has anything but letters,
// digits and %+,-./:=@_ .
std::string shell_word(std::string_view word);

// Words, joined by blanks.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace domefall
