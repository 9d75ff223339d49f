#include "pipeline/diagram/page.h"

#include <fmt/core.h>

#include "pipeline/diagram/panels.h"

namespace domefall {
namespace {

constexpr double kWidth = 1400, kLeft = 80;

std::string subtitle(const Show& show) {
  const int frames = frame_count(show);
  const double seconds = segment_times(show).back();
  std::string text = fmt::format("{}  \u00b7  {} s  \u00b7  {} frames at {} a second",
                                 show.file.filename().string(), number_text(seconds), frames,
                                 number_text(show.frames_per_second));
  if (!show.mass_solar) return text;
  return fmt::format("{}  \u00b7  {} solar masses, 1 M = {} s", text, number_text(*show.mass_solar),
                     number_text(*show.mass_solar * kSecondsPerSolarMass));
}

void draw_title(Svg& page, const Show& show) {
  constexpr double kSmall = 14, kRoom = kWidth - 2 * kLeft;
  double size = 28;
  while (size > 18 && text_width(show.title, size) > kRoom) size -= 2;
  page.text({kLeft, 54}, shortened(show.title, size, kRoom), {size, "#1b1e24", "start", true});
  page.text({kLeft, 80}, shortened(subtitle(show), kSmall, kRoom), {kSmall, "#5a606c"});
}

constexpr PageBox kTimes{kLeft, 132, kWidth - 150, 372};

}  // namespace

std::string show_page(const Show& show) {
  const Path path = sample_path(show);
  Svg page(kWidth, show.mass_solar ? 1010 : 490);
  draw_title(page, show);
  if (show.mass_solar) {
    draw_radius_panel(page, kTimes, show, path);
    draw_orbit_panel(page, {kLeft, 466, kLeft + 460, 926}, path);
    draw_penrose_panel(page, {620, 506, 1340, 866}, path);
  } else {
    draw_speed_panel(page, kTimes, show, path);
    page.text(
        {kLeft, 448},
        "flat space: no hole. The place does not change, so there is neither a radius, nor an "
        "orbit, nor a Carter\u2013Penrose diagram to draw.",
        {14, "#5a606c"});
  }
  return page.document();
}

}  // namespace domefall
