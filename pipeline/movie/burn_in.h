// What a review movie has written in its corners: the number of each frame, and what the show is
// doing.
#pragma once

#include <string>
#include <vector>

#include "pipeline/movie/preset.h"
#include "pipeline/show/show.h"

namespace domefall {

// Subtitles in the ASS format, by which each of the frames, in their order, has a tenth of a
// second.
// In the corners, which the circle of a dome leaves free:
//   top left       the frame's number and the show's time
//   top right      the region and r
//   bottom left    the proper time
//   bottom right   the speed, against an observer who stands still where there can be one, and else
//                  as celerity against free fall; the range of 1 + z of the sky's light
std::string burn_in(const Show& show, const std::vector<int>& frames, const MovieSize& size);

}  // namespace domefall
