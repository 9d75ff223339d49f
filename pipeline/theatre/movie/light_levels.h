// The light levels of a movie for HDR, by which a screen fits what is brighter than it can show.
#pragma once

#include "pipeline/image/frame_buffer.h"

namespace domefall {

// CTA-861.3, Annex P: of each pixel the largest channel counts, in cd/m^2.
struct LightLevels {
  double content = 0;        // MaxCLL: the brightest pixel of all frames
  double frame_average = 0;  // MaxFALL: the largest mean of a frame, corners of a dome and all
};

// Takes a frame of PQ codes into the levels of its movie.
void take_levels(const GradedFrame& frame, LightLevels& levels);

}  // namespace domefall
