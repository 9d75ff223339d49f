// Titles may hold counters: {r} in a text stands for the observer's r at the instant of a frame.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/show/frame_state.h"

namespace domefall {

// Says whether a title's text holds a counter.  It may have been misspelt.
bool has_counters(std::string_view text);

// Returns what is wrong with the braces and the counters of a title's text, for a message, or an
// empty text.  The show has its hole and its beginning already, which some counters need.
std::string counter_mistake(std::string_view text, const Show& show);

// Returns the text that a frame shows for a title: with numbers in the place of its counters, and
// single braces in the place of double ones.  In a dissolve the numbers are those of the view that
// is seen better.
//
// A title has one format for each of its counters, which follows from its first and its last frame,
// so that digits stay where they are.  The units are those that docs/show-format.md gives.  Numbers
// that would be a tie or a whole step are taken as a millionth of a step more, since their last
// bits differ between processors.  The text must be one without mistakes.
std::string text_at(const Show& show, const Title& title, const FrameState& state);

// Returns the number of the first frame that lies in a title's time, which is a later one if the
// show ends before it.
int first_frame_of(const Show& show, const Title& title);

}  // namespace domefall
