// Which frames of a show a command is about.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// "7", "0-299", "0-599x10" (every tenth), or several of these joined by commas; empty text: all
// `count` frames.  Sorted, each once.  Throws InputError naming the bound.
std::vector<int> parse_frames(const std::string& text, int count);

}  // namespace domefall
