#include "pipeline/movie/burn_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/show/frame_state.h"
#include "pipeline/show/show_time.h"
#include "pipeline/survey/shift_range.h"

namespace domefall {
namespace {

// A tenth of a second as the format counts: H:MM:SS.hundredths.
std::string ass_time(std::size_t tenths) {
  return fmt::format("{}:{:02}:{:02}.{}0", tenths / 36000, tenths / 600 % 60, tenths / 10 % 60,
                     tenths % 10);
}

// Numbers of one length, so that they do not tremble from frame to frame.
std::string steady_number(double value) {
  const double size = std::abs(value);
  if (size != 0 && (size < 1e-3 || size >= 1e5)) return fmt::format("{:.3e}", value);
  return fmt::format("{:.{}f}", value, size < 10 ? 4 : size < 1000 ? 2 : 0);
}

std::string motion_of(const Show& show, const ObserverState& o) {
  const bool has_rest = is_flat(o) || o.r > 2;
  std::string text;
  if (has_rest) {
    const double celerity = static_celerity(o).length();
    text = fmt::format("v = {:.5f} c", celerity / std::hypot(1.0, celerity));
  } else {
    text = fmt::format("gamma v = {} (free fall)", steady_number(o.celerity.length()));
  }
  if (const auto range = frequency_range(o, false, !show.effects.lensing))
    text += fmt::format("\\N1+z = {} to {}", steady_number(1 / range->largest),
                        steady_number(1 / range->least));
  return text;
}

std::string place_of(const ObserverState& o) {
  if (is_flat(o)) return "flat space";
  return fmt::format("region {}\\Nr = {} M", region_name(o.region), steady_number(o.r));
}

std::string clock_of(const Show& show, const ObserverState& o) {
  if (is_flat(o)) return fmt::format("tau = {} s", steady_number(o.proper_time));
  std::string text = fmt::format("tau = {} M", steady_number(o.proper_time));
  if (show.mass_solar)
    text += fmt::format("\\N{} s",
                        steady_number(o.proper_time * *show.mass_solar * kSecondsPerSolarMass));
  return text;
}

}  // namespace

std::string burn_in(const Show& show, const std::vector<int>& frames, const MovieSize& size) {
  const int font = std::max(8, std::min(size.width, size.height) / 48);
  std::string text = fmt::format(
      "[Script Info]\nScriptType: v4.00+\nPlayResX: {}\nPlayResY: {}\nWrapStyle: 2\n\n[V4+ "
      "Styles]\n"
      "Format: Name, Fontname, Fontsize, PrimaryColour, OutlineColour, BackColour, BorderStyle, "
      "Outline, Shadow, Alignment, MarginL, MarginR, MarginV\n",
      size.width, size.height);
  // Alignments as on the keys of a calculator.
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
    line("a", 0, fmt::format("frame {}\\N{}", state.frame, clock_text(state.show_time_s)));
    line("b", 1, place_of(state.observer));
    line("c", 2, clock_of(show, state.observer));
    line("d", 3, motion_of(show, state.observer));
  }
  return text;
}

}  // namespace domefall
