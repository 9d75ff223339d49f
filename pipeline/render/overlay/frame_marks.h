// Overlays for review and for teaching: lines that belong to the dome and curves that belong to the
// hole.
#pragma once

#include "pipeline/render/overlay/frame_ref.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Below its rim a dome's picture is often hidden by seats and by the light of doors.
inline constexpr double kSafeElevationDeg = 10;
// Where the audience of a dome looks without turning and leaning back.
inline constexpr double kSweetAzimuthDeg = 45, kSweetLowestDeg = 15, kSweetHighestDeg = 60;
// The parts of a flat picture in which action and titles are safe, and its middle third.
inline constexpr double kSafeAction = 0.9, kSafeTitles = 0.8, kMiddleThird = 1. / 3;

// The width of lines, in pixels.
double mark_width(const Projection& projection);

// Draws one of the overlays that are lines over a frame: all but names and numbers.  In a dissolve
// the curves of both views are drawn, each as far as it is seen.
void draw_marks(OverlayKind overlay, const Show& show, const FrameState& state,
                const FrameRef& frame);

}  // namespace domefall
