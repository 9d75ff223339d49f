// This file has the options --frame and --at.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/show/show.h"

namespace domefall {

// A FrameChoice holds the values of --frame and --at for a verb about one frame.
struct FrameChoice {
  int frame = 0;
  std::string at;  // seconds, minutes and seconds, or a marker's name; empty if not given
};
void add_frame_choice(CLI::App& verb, FrameChoice& choice);

// Returns the frame that is chosen, which for a time is the frame nearest to it.  Throws InputError
// for what the show does not have.
int chosen_frame(const FrameChoice& choice, const Show& show);

}  // namespace domefall
