// By this grade a screen shows what is made for a dome.
#pragma once

#include "pipeline/grade/grader.h"
#include "pipeline/render/renderer.h"

namespace domefall {

// Returns settings for a screen.  The default display is for domes, and a preview is for screens.
// The displays of a show's own configuration are not known, and stay.
GradeSettings for_a_screen(GradeSettings settings);

// Changes a flat picture of a dome as the dome's own light does, which depends on the light of the
// whole dome.  `dome` is the frame as the show has it, and the grader has a dome_light().
void change_as_in_dome(const Grader& grader, Renderer& renderer, const FrameState& dome,
                       GradedFrame& picture);

}  // namespace domefall
