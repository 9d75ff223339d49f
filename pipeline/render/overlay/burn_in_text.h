// For review, the corners of frames say which frame it is and what the show is doing.  This file
// makes their texts.
#pragma once

#include <string>

#include "pipeline/show/frame_state.h"

namespace domefall {

// The texts stand in the corners, which the circle of a dome leaves free.  Every line except the
// last ends in '\n'.  Numbers have a constant length, so that they do not tremble from frame to
// frame.  In a dissolve they belong to the view that is seen better.
struct BurnInText {
  std::string top_left;     // the frame's number and the show's time
  std::string top_right;    // the region and r, and whether that is in an ergosphere
  std::string bottom_left;  // the proper time
  // The last text gives the speed and the range of 1 + z of the light of one sky, which is the own
  // sky of the observer's tetrad.  The speed is the one against an observer at rest, where there
  // can be one.  Elsewhere the text gives the celerity against free fall.
  std::string bottom_right;
};
// Says whether an observer is in the ergosphere of a hole that spins.
bool is_in_ergosphere(const ObserverState& observer);

BurnInText burn_in_text(const Show& show, const FrameState& state);

}  // namespace domefall
