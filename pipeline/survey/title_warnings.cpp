#include "pipeline/survey/title_warnings.h"

#include <fmt/format.h>

#include <numbers>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/frame_titles.h"
#include "pipeline/render/overlay/text_surface.h"
#include "pipeline/show/problems.h"

namespace domefall {
namespace {

void add_warnings(const Show& show, const Title& title, std::vector<ShowWarning>& warnings) {
  const int frame = nearest_frame(show, title.begin_s);
  const FrameState state = frame_state(show, frame);
  const LetteredText& letters = title_letters(title);
  const TextSurface surface(state.camera_from_audience, title.azimuth, title.elevation,
                            title.height);
  const auto warn = [&](const std::string& what) {
    warnings.push_back(
        {title.begin_s, frame, state.segment, "the title '" + shown(title.text) + "' " + what});
  };
  if (!letters.font_found)
    warn("asks for the font '" + shown(title.style.font) +
         "', which this machine does not have, so that another one stands in for it");
  if (letters.missing > 0)
    warn(fmt::format("has {} letter{} that no font of this machine has, drawn as boxes",
                     letters.missing, letters.missing == 1 ? "" : "s"));
  const auto middle = pixel_of(state.projection, surface.direction({0, 0}));
  if (!middle || !is_in_picture(state.projection, *middle))
    warn("has its middle outside the picture");
  if (surface.half_turn(letters.half_width) > std::numbers::pi)
    warn(
        "is longer than its circle of the dome, so that it runs into itself; a smaller height_deg "
        "or "
        "more lines would fit");
}

}  // namespace

std::vector<ShowWarning> title_warnings(const Show& show) {
  std::vector<ShowWarning> warnings;
  for (const Title& title : show.titles) add_warnings(show, title, warnings);
  for (const Segment& segment : show.timeline)
    for (const Title& title : segment.titles) add_warnings(show, title, warnings);
  return warnings;
}

}  // namespace domefall
