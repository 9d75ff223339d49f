#include <fmt/core.h>

#include <algorithm>

#include "pipeline/program/diagram/draw_panels.h"

namespace domefall {
namespace {

constexpr double kLabelSize = 12;
// The names of the segments take the uppermost pixels of the box.
constexpr double kBand = 22, kTopOfCurves = 30;

Scale time_scale(const PageBox& box, const Show& show) {
  return {0, segment_times(show).back(), box.left, box.right};
}

// Returns the label "2 infall", "2" or none, as there is room.
std::string band_label(const Show& show, std::size_t k, double room) {
  const std::string digits = fmt::format("{}", k + 1);
  const std::string full = fmt::format("{} {}", digits, show.timeline[k].type);
  for (const std::string& text : {full, digits})
    if (text_width(text, kLabelSize) < room) return text;
  return "";
}

// Where two segments dissolve, the band of one tapers off as that of the other grows.
void shade_segments(Svg& page, const PageBox& box, const Scale& x, const Show& show) {
  const std::vector<double> times = segment_times(show);
  // The white band hides the grid behind the names.
  page.rectangle({box.left, box.top, box.right, box.top + kBand}, "#ffffff");
  for (std::size_t k = 0; k < show.timeline.size(); ++k) {
    const double begin = x(times[k]), end = x(times[k] + show.timeline[k].duration_s);
    const double grown = x(times[k] + show.timeline[k].dissolve_s), tapers = x(times[k + 1]);
    const std::string colour = segment_colour(static_cast<int>(k));
    const double bottom = box.top + kBand;
    page.area({{grown, box.top}, {end, box.top}, {tapers, bottom}, {begin, bottom}}, colour, 0.22);
    page.rectangle({begin, bottom, end, box.bottom}, colour, 0.07);
    const double from = (begin + grown) / 2, to = (tapers + end) / 2;
    const std::string label = band_label(show, k, to - from - 6);
    if (!label.empty())
      page.text({(from + to) / 2, box.top + 15.5}, label,
                {kLabelSize, colour.c_str(), "middle", true});
  }
}

// Draws a line between segments, or one at either end of a dissolve.  Where the place jumps, the
// line is heavier.  A jump and a dissolve have a label, if there is room for it.
void mark_cuts(Svg& page, const PageBox& box, const Scale& x, const Path& path, const Show& show) {
  const std::vector<double> times = segment_times(show);
  double free_from = box.left;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const PathPoint &a = path.points[i - 1], &b = path.points[i];
    if (a.segment == b.segment) continue;
    const auto k = static_cast<std::size_t>(b.segment);
    const double dissolve = show.timeline[k].dissolve_s, at = x(times[k]);
    const bool jump = is_jump(a, b);
    const Stroke stroke = jump ? Stroke{"#30343c", 1.4, "6 3"} : Stroke{"#a3a9b5", 1};
    page.line({at, box.top}, {at, box.bottom}, stroke);
    if (dissolve > 0)
      page.line({x(times[k] + dissolve), box.top}, {x(times[k] + dissolve), box.bottom}, stroke);
    const char* word = dissolve > 0 ? "dissolve" : "cut";
    if ((!jump && !(dissolve > 0)) || at < free_from) continue;
    page.text({at + 4, box.bottom - 6}, word, {11, "#30343c", "start", false, true, true});
    free_from = at + text_width(word, 11) + 12;
  }
}

void draw_curve(Svg& page, const Path& path, const Scale& x, const Scale& y,
                double PathPoint::*quantity) {
  std::vector<PagePoint> points;
  int segment = 0;
  const auto finish = [&] {
    page.curve(points, {segment_colour(segment), 2.4});
    points.clear();
  };
  for (const PathPoint& p : path.points) {
    if (p.segment != segment) finish();
    segment = p.segment;
    points.push_back({x(p.time_s), y(p.*quantity)});
  }
  finish();
}

// The names of the radii stand beside the box, apart from each other.
void mark_radii(Svg& page, const PageBox& box, const Scale& y, const Spacetime& spacetime) {
  constexpr double kApart = 16, kAboveAxis = 6;
  const std::vector<RadiusMark> marks = radius_marks(spacetime);
  std::vector<double> names;
  for (const RadiusMark& mark : marks) {
    names.push_back(y(mark.r));
    page.line({box.left, names.back()}, {box.right, names.back()},
              mark.is_horizon ? Stroke{"#16181d", 1.6} : Stroke{"#16181d", 1.2, "5 4"});
  }
  // Two neighbours make room for each other, and the lowest stays above the axis.
  for (std::size_t k = 1; k < names.size(); ++k) {
    const double spread = std::max(0.0, kApart - (names[k - 1] - names[k])) / 2;
    names[k - 1] += spread, names[k] -= spread;
  }
  double below = box.bottom - kAboveAxis + kApart;
  for (std::size_t k = 0; k < names.size(); ++k) {
    below = std::min(names[k], below - kApart);
    page.text({box.right + 8, below + 4},
              fmt::format("{} r = {}", marks[k].name, number_text(marks[k].r)), {12});
  }
}

PlaceOnPage draw_time_panel(Svg& page, const PageBox& box, const Show& show, const Path& path,
                            const Scale& y, double PathPoint::*quantity, bool marks_radii) {
  const Scale x = time_scale(box, show);
  draw_axes(page, box, x, y, 12, 6);
  shade_segments(page, box, x, show);
  if (marks_radii) mark_radii(page, box, y, show.spacetime);
  mark_cuts(page, box, x, path, show);
  page.text({box.right, box.bottom + 36}, "show time (s)", {13, "#30343c", "end"});
  draw_curve(page, path, x, y, quantity);
  return [x, y, quantity](const PathPoint& p) { return PagePoint{x(p.time_s), y(p.*quantity)}; };
}

Scale radius_scale(const PageBox& box, const Path& path) {
  double least = path.points.front().r, most = least;
  for (const PathPoint& p : path.points) {
    least = std::min(least, p.r);
    most = std::max(most, p.r);
  }
  const double top = box.top + kTopOfCurves;
  constexpr double kLogarithmicFrom = 20;
  if (most > kLogarithmicFrom * least)
    return {std::min(least, 1.9) * 0.8, std::max(most, 3.2), box.bottom, top, true};
  return {0, std::max(most, 3.2), box.bottom, top, false};
}

}  // namespace

PlaceOnPage draw_radius_panel(Svg& page, const PageBox& box, const Show& show, const Path& path) {
  const Scale y = radius_scale(box, path);
  draw_heading(page, box,
               fmt::format("Radius r ({}){}", unit_of(show.spacetime),
                           y.logarithmic ? ", logarithmic" : ""));
  page.begin_group("radius");
  PlaceOnPage place = draw_time_panel(page, box, show, path, y, &PathPoint::r, true);
  page.end_group();
  return place;
}

PlaceOnPage draw_speed_panel(Svg& page, const PageBox& box, const Show& show, const Path& path) {
  draw_heading(page, box, "Speed (that of light is 1)");
  page.begin_group("speed");
  PlaceOnPage place =
      draw_time_panel(page, box, show, path, {0, 1, box.bottom, box.top + kTopOfCurves, false},
                      &PathPoint::speed, false);
  page.end_group();
  return place;
}

}  // namespace domefall
