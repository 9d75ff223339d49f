// The options --frames, --frame and --at.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "pipeline/show/show.h"

namespace domefall {

// The frames that a text names, sorted and each once: "7", "0-299", "0-599x10" (every tenth), or
// several of these joined by commas.  An empty text stands for all `count` frames.  Throws
// InputError for any other text and for frames that the show does not have.
std::vector<int> parse_frames(const std::string& text, int count);

// The options --frame and --at of verbs for one frame.
struct FrameChoice {
  int frame = 0;
  std::string at;  // seconds, minutes and seconds, or a marker's name; empty if not given
};
void add_frame_choice(CLI::App& verb, FrameChoice& choice);

// The frame that is chosen; of a time, the frame nearest to it.  Throws InputError for what the
// show does not have.
int chosen_frame(const FrameChoice& choice, const Show& show);

}  // namespace domefall
