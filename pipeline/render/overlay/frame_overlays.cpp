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
constexpr int kOverlayVersion = 3;

LetterStyle burn_in_style(TextAlign align) { return {"Monospace", align}; }

// Puts a text into a corner of the image, on a dark ground that makes it legible on bright skies.
void draw_in_corner(const std::string& text, bool right, bool bottom, const Projection& projection,
                    const FrameRef& frame) {
  // Lines of 28 letters fit beside the circle of a dome.
  constexpr double kLetterPart = 1. / 88, kLeastLetter = 5.5, kGround = 0.6;
  const double letter = std::max(kLeastLetter, kLetterPart * shorter_side(projection));
  const ScreenSides pixel = screen_sides(projection);
  const LetteredText letters =
      lettered(text, burn_in_style(right ? TextAlign::kRight : TextAlign::kLeft));
  const double high = letter / pixel.y, wide = letter / pixel.x;  // of a capital, in pixels
  const double w = letters.half_width * wide, h = letters.half_height * high;
  const ImagePoint middle{right ? frame.width - w - wide : w + wide,
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
  draw_in_corner(corners.top_left, false, false, state.projection, frame);
  draw_in_corner(corners.top_right, true, false, state.projection, frame);
  draw_in_corner(corners.bottom_left, false, true, state.projection, frame);
  draw_in_corner(corners.bottom_right, true, true, state.projection, frame);
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
    else if (overlay == OverlayKind::kStarNames)
      labels.draw(dominant_view(state), frame, left);
    else if (overlay != OverlayKind::kNoTitles)
      draw_marks(overlay, show, state, frame);
  }
}

}  // namespace domefall
