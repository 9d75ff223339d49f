// The option --frames.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// The frames that a text names, sorted and each once: "7", "0-299", "0-599x10" (every tenth), or
// several of these joined by commas.  An empty text stands for all `count` frames.  Throws
// InputError for any other text and for frames that the show does not have.
std::vector<int> parse_frames(const std::string& text, int count);

}  // namespace domefall
