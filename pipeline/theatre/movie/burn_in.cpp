#include "pipeline/theatre/movie/burn_in.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/render/overlay/burn_in_text.h"
#include "pipeline/show/frame_state.h"

namespace domefall {
namespace {

// Returns a time, counted in tenths of a second, as the ASS format writes it, H:MM:SS.hundredths.
std::string ass_time(std::size_t tenths) {
  return fmt::format("{}:{:02}:{:02}.{}0", tenths / 36000, tenths / 600 % 60, tenths / 10 % 60,
                     tenths % 10);
}

std::string ass_lines(std::string text) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at))
    text.replace(at, 1, "\\N");
  return text;
}

}  // namespace

std::string burn_in(const Show& show, const std::vector<int>& frames, const MovieSize& size) {
  if (std::ranges::find(show.overlays, OverlayKind::kBurnIn) != show.overlays.end()) return {};
  const int font = std::max(8, std::min(size.width, size.height) / 48);
  std::string text = fmt::format(
      "[Script Info]\nScriptType: v4.00+\nPlayResX: {}\nPlayResY: {}\nWrapStyle: 2\n\n[V4+ "
      "Styles]\n"
      "Format: Name, Fontname, Fontsize, PrimaryColour, OutlineColour, BackColour, BorderStyle, "
      "Outline, Shadow, Alignment, MarginL, MarginR, MarginV\n",
      size.width, size.height);
  // The ASS format numbers the alignments like the keys of a numeric keypad.
  for (const auto& [name, alignment] : {std::pair{"a", 7}, {"b", 9}, {"c", 1}, {"d", 3}})
    text +=
        fmt::format("Style: {},monospace,{},&H00C0C0C0,&H00000000,&H00000000,1,1,0,{},{},{},{}\n",
                    name, font, alignment, font / 2, font / 2, font / 2);
  text += "\n[Events]\nFormat: Layer, Start, End, Style, Text\n";
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const FrameState state = frame_state(show, frames[k]);
    // Each corner is a layer of its own, since texts of one layer make room for each other.
    const auto line = [&](const char* style, int layer, const std::string& what) {
      text += fmt::format("Dialogue: {},{},{},{},{}\n", layer, ass_time(k), ass_time(k + 1), style,
                          what);
    };
    const BurnInText corners = burn_in_text(show, state);
    line("a", 0, ass_lines(corners.top_left));
    line("b", 1, ass_lines(corners.top_right));
    line("c", 2, ass_lines(corners.bottom_left));
    line("d", 3, ass_lines(corners.bottom_right));
  }
  return text;
}

}  // namespace domefall
