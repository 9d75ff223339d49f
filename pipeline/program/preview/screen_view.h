// These are the cameras by which screens look at the frames of a show.
#pragma once

#include "pipeline/grade/grader.h"
#include "pipeline/program/preview/picture_request.h"
#include "pipeline/render/renderer.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Gives a frame another projection.  A flat view of a dome is that of someone in the seats,
// straight at the camera's target or, where the camera is given by angles, 45 degrees up the front
// of the dome.  A picture of the whole sphere has the audience's front in its middle and their
// zenith up.  Titles stay where they are for the audience.
void see_in(const Show& show, const Projection& projection, FrameState& state);

// Turns a frame's camera to look somewhere.  A flat picture has that place in its middle, and one
// for an audience has it 45 degrees above the front.
void turn_to(const ScreenLook& look, FrameState& state);

// Returns what a camera is said to be in a show's file, as YAML, so that a frame of the show looks
// as a picture does.  The show's own camera keeps its target, unless it is just turning from one to
// another.  One that was `turned` in the preview has `euler_deg`, and a dome gets what is in the
// middle of a flat picture 45 degrees above its front.
std::string camera_as_yaml(const Show& show, const FrameState& state, bool turned);

// Returns settings for a screen.  The default display is for domes, and a preview is for screens.
// The displays of a show's own configuration are not known, and stay.
GradeSettings for_a_screen(GradeSettings settings);

// Changes a flat picture of a dome as the dome's own light does, which depends on the light of the
// whole dome.  `dome` is the frame as the show has it, and the grader has a dome_light().
void change_as_in_dome(const Grader& grader, Renderer& renderer, const FrameState& dome,
                       GradedFrame& picture);

}  // namespace domefall
