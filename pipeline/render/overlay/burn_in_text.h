// What is written into the corners of frames for review: which frame it is, and what the show is
// doing.
#pragma once

#include <string>

#include "pipeline/show/frame_state.h"

namespace domefall {

// The texts of the corners, which the circle of a dome leaves free.  Lines end in '\n', but for the
// last.  Numbers are of one length, so that they do not tremble from frame to frame.  In a dissolve
// they are those of the view that is seen better.
struct BurnInText {
  std::string top_left;      // the frame's number and the show's time
  std::string top_right;     // the region and r
  std::string bottom_left;   // the proper time
  std::string bottom_right;  // the speed, against an observer who stands still where there can be
                             // one, and else as celerity against free fall; the range of 1 + z of
                             // the home sky's light
};
BurnInText burn_in_text(const Show& show, const FrameState& state);

}  // namespace domefall
