#include "pipeline/program/diagram/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "pipeline/program/diagram/draw_panels.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

constexpr double kPageWidth = 1400, kLeft = 80;

std::string subtitle(const Show& show) {
  const int frames = frame_count(show);
  const double seconds = segment_times(show).back();
  std::string text = fmt::format("{}  \u00b7  {} s  \u00b7  {} frames at {} a second",
                                 show.file.filename().string(), number_text(seconds), frames,
                                 number_text(show.frames_per_second));
  if (show.spacetime.is_flat()) return text;
  if (const auto* wormhole = std::get_if<Wormhole>(&show.spacetime.kind()))
    return fmt::format("{}  \u00b7  throat of {} km", text, number_text(wormhole->radius_km));
  if (const auto* hole = std::get_if<ChargedHole>(&show.spacetime.kind()))
    text += fmt::format("  \u00b7  charge {}", number_text(hole->charge));
  if (const auto* spinning = std::get_if<SpinningHole>(&show.spacetime.kind())) {
    text += fmt::format("  \u00b7  spin {}", number_text(static_cast<double>(spinning->kerr.spin)));
    if (spinning->kerr.charge > 0)
      text += fmt::format(", charge {}", number_text(static_cast<double>(spinning->kerr.charge)));
  }
  return fmt::format("{}  \u00b7  {} solar masses, 1 M = {} s", text,
                     number_text(*show.spacetime.solar_masses()),
                     number_text(show.spacetime.seconds_per_m()));
}

void draw_title(Svg& page, const Show& show) {
  constexpr double kSmall = 14, kRoom = kPageWidth - 2 * kLeft;
  double size = 28;
  while (size > 18 && text_width(show.title, size) > kRoom) size -= 2;
  page.text({kLeft, 54}, shortened(show.title, size, kRoom), {size, "#1b1e24", "start", true});
  page.text({kLeft, 80}, shortened(subtitle(show), kSmall, kRoom), {kSmall, "#5a606c"});
}

// The names of radii stand to the right of the box.  Those of a charge are longer.
PageBox times_box(const Spacetime& spacetime) {
  return {kLeft, 132, kPageWidth - (two_horizons(spacetime) ? 190 : 150), 372};
}

struct DrawnPage {
  std::string svg;
  double height;
  std::vector<PlaceOnPage> places;  // of each panel
};

DrawnPage drawn_page(const Show& show, const Path& path) {
  const bool flat = show.spacetime.is_flat(), kruskal = show.spacetime.is<Schwarzschild>();
  const PageBox diagram = flat || kruskal ? PageBox{620, 506, 1340, 866}
                                          : blocks_box({700, 506}, 560, show.spacetime, path);
  const auto* spinning = std::get_if<SpinningHole>(&show.spacetime.kind());
  const PageBox side{kLeft, 1076, kLeft + 460, 1536};
  const double height = flat       ? 490
                        : spinning ? std::max(side.bottom, diagram.bottom) + 84
                                   : std::max(1010.0, diagram.bottom + 84);
  Svg page(kPageWidth, height);
  draw_title(page, show);
  std::vector<PlaceOnPage> places;
  if (!flat) {
    places.push_back(draw_radius_panel(page, times_box(show.spacetime), show, path));
    places.push_back(draw_orbit_panel(page, {kLeft, 466, kLeft + 460, 926}, show.spacetime, path));
    places.push_back(kruskal ? draw_penrose_panel(page, diagram, path)
                             : draw_blocks_panel(page, diagram, show.spacetime, path));
    if (spinning) places.push_back(draw_side_panel(page, side, *spinning, path));
  } else {
    places.push_back(draw_speed_panel(page, times_box(show.spacetime), show, path));
    page.text(
        {kLeft, 448},
        "flat space: no hole. The place does not change, so there is neither a radius, nor an "
        "orbit, nor a Carter\u2013Penrose diagram to draw.",
        {14, "#5a606c"});
  }
  return {page.document(), height, places};
}

// Returns the index of the last point of a segment that is not later than a time, or that of the
// segment's first point if all are later.
std::size_t point_before(const Path& path, double time_s, int segment) {
  const auto later = std::upper_bound(
      path.points.begin(), path.points.end(), std::pair(segment, time_s),
      [](const auto& at, const auto& p) { return at < std::pair(p.segment, p.time_s); });
  auto before = later == path.points.begin() ? later : later - 1;
  if (before->segment < segment) before = later;
  return static_cast<std::size_t>(before - path.points.begin());
}

PagePoint between(const PagePoint& a, const PagePoint& b, double part) {
  return {std::lerp(a.x, b.x, part), std::lerp(a.y, b.y, part)};
}

}  // namespace

std::string show_page(const Show& show) { return drawn_page(show, sample_path(show)).svg; }

MarkedPage marked_page(const Show& show, int instants) {
  const Path path = sample_path(show);
  const DrawnPage page = drawn_page(show, path);
  const std::vector<double> times = segment_times(show);
  MarkedPage marked{page.svg, kPageWidth, page.height, times.back() / (instants - 1), {}};
  for (int k = 0; k < instants; ++k) {
    const double time = marked.step_s * k;
    const int segment = segment_at(show, time);
    const std::size_t before = point_before(path, time, segment);
    const PathPoint& a = path.points[before];
    const PathPoint& next = path.points[std::min(before + 1, path.points.size() - 1)];
    const PathPoint& b = next.segment == a.segment ? next : a;
    const double step = b.time_s - a.time_s;
    const double part = step > 0 ? std::clamp((time - a.time_s) / step, 0.0, 1.0) : 0;
    marked.places.emplace_back();
    for (const PlaceOnPage& place : page.places)
      marked.places.back().push_back(between(place(a), place(b), part));
  }
  return marked;
}

}  // namespace domefall
