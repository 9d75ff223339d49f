// For review and for teaching, overlays draw lines that belong to the dome and curves that belong
// to the hole.
#pragma once

#include "pipeline/render/overlay/frame_ref.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Up to this angle from its rim, a dome's picture is often hidden by seats and by the light of
// doors.
inline constexpr double kSafeElevationDeg = 10;
// Here the audience of a dome looks without turning or leaning back.
inline constexpr double kSweetAzimuthDeg = 45, kSweetLowestDeg = 15, kSweetHighestDeg = 60;
// In a flat image action and titles are safe within these parts of its sides.  The sweet spot is
// the middle third.
inline constexpr double kSafeAction = 0.9, kSafeTitles = 0.8, kMiddleThird = 1. / 3;

// Returns the width of lines, in pixels.
double mark_width(const Projection& projection);

// Draws one of the overlays that consist of lines over a frame, which are all except names and
// numbers.  In a dissolve the curves of both views are drawn, each with the opacity of its view.
void draw_marks(OverlayKind overlay, const Show& show, const FrameState& state,
                const FrameRef& frame);

}  // namespace domefall
