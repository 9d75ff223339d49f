// For review and for teaching, overlays draw lines that belong to the dome and curves that belong
// to the hole.
#pragma once

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// These values place lines for the eye, and nothing else in a frame depends on them.

// Up to this angle from its rim, a dome's picture is often hidden by seats and by the light of
// doors.  IMERSA's safe area ends there, too, and docs/overlays.md has the same angle for titles.  A
// larger angle would give up more of the picture, and a smaller one would call safe what some seats
// do not see.
inline constexpr double kSafeElevationDeg = 10;
// IMERSA calls safe what lies up to 50 degrees to either side of the front and from 10 to 60
// degrees high.
inline constexpr double kSafeAzimuthDeg = 50, kSafeHighestDeg = 60;
// Here the audience of a dome looks without turning or leaning back.  The bounds are our choice.
// Productions for domes name 35 to 45 degrees above the front of the rim as the place to which an
// audience looks, and the bounds leave 15 to 20 degrees below and above it.  45 degrees to either
// side are halfway to a seat's left and right.  Wider bounds would take in what is seen only by
// turning the head, and narrower ones would leave out what is seen without.
inline constexpr double kSweetAzimuthDeg = 45, kSweetLowestDeg = 15, kSweetHighestDeg = 60;
// In a flat image action and titles are safe within these parts of its sides.  They are those of
// SMPTE RP 218, which was made for tubes that hide the edges of a picture.  SMPTE ST 2046-1 allows
// 0.93 and 0.9 on flat screens, so whatever lies within our lines lies within its lines too.
inline constexpr double kSafeAction = 0.9, kSafeTitles = 0.8;
// The sweet spot of a flat image has this part of its sides, as the rule of thirds divides them.
// It is our choice, and a larger part would mark more of the image as its middle.
inline constexpr double kMiddleThird = 1. / 3;

// Returns the width of lines, in the unit of ScreenSides.
double mark_width(const Projection& projection);

// Draws one of the overlays that consist of lines over a frame, which are all except names and
// numbers.  In a dissolve the curves of both views are drawn, each with the opacity of its view.
void draw_marks(OverlayKind overlay, const Show& show, const FrameState& state,
                const FrameRef& frame);

}  // namespace domefall
