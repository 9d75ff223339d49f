// These functions read and write lists of frames as text, such as 7, 0-299 or 0-9,12.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// Returns the frames that a text names, sorted and each once: "7", "0-299", "0-599x10" (every
// tenth), or several of these joined by commas.  An empty text stands for all `count` frames.
// Throws InputError, which names the option --frames, for any other text and for frames from
// `count` on.
std::vector<int> parse_frames(const std::string& text, int count);

// Returns frames that ascend as ranges, such as 0-9,12,20-90x10, which parse_frames() reads.
std::string as_ranges(const std::vector<int>& frames);

}  // namespace domefall
