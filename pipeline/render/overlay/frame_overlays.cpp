#include "pipeline/render/overlay/frame_overlays.h"

#include <algorithm>

#include "pipeline/base/digest.h"
#include "pipeline/render/overlay/bent_text.h"
#include "pipeline/render/overlay/burn_in_text.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_marks.h"
#include "pipeline/render/rays/key_rounding.h"

namespace domefall {
namespace {

// This number is raised with every change of how overlays are drawn.
constexpr int kOverlayVersion = 4;

LetterStyle burn_in_style(TextAlign align) { return {"Monospace", align}; }

// Puts a text into a corner of the image, or between two, on a dark ground that makes it legible on
// bright skies.
void draw_at_rim(const std::string& text, TextAlign align, bool bottom,
                 const Projection& projection, const FrameRef& frame) {
  // Lines of 28 letters fit beside the circle of a dome.
  constexpr double kLetterPart = 1. / 88, kLeastLetter = 5.5, kGround = 0.6;
  const double letter = std::max(kLeastLetter, kLetterPart * shorter_side(projection));
  const ScreenSides pixel = screen_sides(projection);
  const LetteredText letters = lettered(text, burn_in_style(align));
  const double high = letter / pixel.y, wide = letter / pixel.x;  // of a capital, in pixels
  const double w = letters.half_width * wide, h = letters.half_height * high;
  const ImagePoint middle{align == TextAlign::kRight    ? frame.width - w - wide
                          : align == TextAlign::kCentre ? frame.width / 2.0
                                                        : w + wide,
                          bottom ? frame.height - h - high : h + high};
  const double x = w + wide / 2, y = h + high / 2;
  Coverage ground(frame.width, frame.height), written(frame.width, frame.height);
  ground.add({{middle.x - x, middle.y - y},
              {middle.x + x, middle.y - y},
              {middle.x + x, middle.y + y},
              {middle.x - x, middle.y + y}});
  add_flat_text(letters, middle, letter, pixel, written);
  draw_anywhere(ground, {{0, 0, 0}, kGround}, frame);
  draw_anywhere(written, {{1, 1, 1}, 1}, frame);
}

void draw_burn_in(const Show& show, const FrameState& state, const FrameRef& frame) {
  const BurnInText corners = burn_in_text(show, state);
  draw_at_rim(corners.top_left, TextAlign::kLeft, false, state.projection, frame);
  draw_at_rim(corners.top_right, TextAlign::kRight, false, state.projection, frame);
  draw_at_rim(corners.bottom_left, TextAlign::kLeft, true, state.projection, frame);
  draw_at_rim(corners.bottom_right, TextAlign::kRight, true, state.projection, frame);
}

// The ergosphere has no outline for who is in it.
void draw_ergosphere(const Show& show, const FrameState& state, const FrameRef& frame) {
  if (is_in_ergosphere(dominant_view(state).observer))
    draw_at_rim("in the ergosphere", TextAlign::kCentre, true, state.projection, frame);
  draw_marks(OverlayKind::kErgosphere, show, state, frame);
}

}  // namespace

std::string overlays_key(const Show& show, const FrameState& state) {
  if (show.overlays.empty()) return {};
  Digest digest;
  digest.add(kOverlayVersion).add(overlay_names(show.overlays));
  add_rotation(digest, state.camera_from_audience);
  // A sample text stands for a font, whose outlines depend on the machine.
  const auto add_font = [&digest](const LetterStyle& style) {
    add_outlines(digest, lettered("Handgloves 0123456789", style));
  };
  for (const OverlayKind overlay : show.overlays) {
    if (overlay == OverlayKind::kStarNames) add_font(label_style());
    if (overlay == OverlayKind::kErgosphere) add_font(burn_in_style(TextAlign::kCentre));
    if (overlay != OverlayKind::kBurnIn) continue;
    add_font(burn_in_style(TextAlign::kLeft));
    const BurnInText corners = burn_in_text(show, state);
    for (const std::string& text :
         {corners.top_left, corners.top_right, corners.bottom_left, corners.bottom_right})
      digest.add(text);
  }
  return digest.hex();
}

void draw_overlays(const Show& show, const FrameState& state, StarLabels& labels,
                   const LightLeft& left, const FrameRef& frame) {
  for (const OverlayKind overlay : show.overlays) {
    if (overlay == OverlayKind::kBurnIn)
      draw_burn_in(show, state, frame);
    else if (overlay == OverlayKind::kErgosphere)
      draw_ergosphere(show, state, frame);
    else if (overlay == OverlayKind::kStarNames)
      labels.draw(dominant_view(state), frame, left);
    else if (overlay != OverlayKind::kNoTitles)
      draw_marks(overlay, show, state, frame);
  }
}

}  // namespace domefall
