#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pipeline/program/diagram/draw_panels.h"

namespace domefall {
namespace {

constexpr double kWidth = 2.2;

// A Stretch is a part of the path that is one stroke.
struct Stretch {
  int segment = 0;
  Region region = Region::kI;
  std::vector<PagePoint> points;
};

const char* dashes_of(Region region) {
  if (region == Region::kIII || region == Region::kVI) return "8 4";
  return region == Region::kIV ? "2 4" : "";
}

std::vector<Stretch> stretches_of(const Path& path, const PlaceOnPage& place,
                                  bool (*joined)(const PathPoint&, const PathPoint&)) {
  std::vector<Stretch> stretches;
  const PathPoint* before = nullptr;
  for (const PathPoint& p : path.points) {
    const bool goes_on = before != nullptr && joined(*before, p);
    if (!goes_on || before->segment != p.segment ||
        dashes_of(before->region) != dashes_of(p.region)) {
      stretches.push_back({p.segment, p.region, {}});
      if (goes_on) stretches.back().points.push_back(place(*before));
    }
    stretches.back().points.push_back(place(p));
    before = &p;
  }
  return stretches;
}

double length_of(const std::vector<PagePoint>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return sum;
}

constexpr double kShortestWithArrow = 45;

struct Arrow {
  PagePoint middle;
  PagePoint along;  // unit vector
};

std::optional<Arrow> arrow_after(const Stretch& stretch, double wanted) {
  double gone = 0;
  for (std::size_t i = 1; i < stretch.points.size(); ++i) {
    const PagePoint &a = stretch.points[i - 1], &b = stretch.points[i];
    const double step = std::hypot(b.x - a.x, b.y - a.y);
    gone += step;
    if (gone < wanted || step == 0) continue;
    const double part = 1 - (gone - wanted) / step;
    return Arrow{{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)},
                 {(b.x - a.x) / step, (b.y - a.y) / step}};
  }
  return std::nullopt;
}

void draw_arrow(Svg& page, const Arrow& arrow, const std::string& colour) {
  constexpr double kSize = 7;
  const PagePoint m = arrow.middle;
  const double dx = kSize * arrow.along.x, dy = kSize * arrow.along.y;
  page.area({{m.x + dx, m.y + dy},
             {m.x - dx - 0.75 * dy, m.y - dy + 0.75 * dx},
             {m.x - 0.4 * dx, m.y - 0.4 * dy},
             {m.x - dx + 0.75 * dy, m.y - dy - 0.75 * dx}},
            colour);
}

// The arrow lies halfway along, or in the first 400 pixels of a long stretch.  It moves aside if
// the mark of an instant is in the way.
void add_arrow(Svg& page, const Stretch& stretch, const std::vector<PagePoint>& dots) {
  constexpr double kFarthest = 400, kClear = 14;
  const double middle = std::min(length_of(stretch.points) / 2, kFarthest);
  for (const double part : {1.0, 0.85, 1.15, 0.7, 1.3, 0.5}) {
    const auto arrow = arrow_after(stretch, part * middle);
    const auto in_the_way = [&](const PagePoint& dot) {
      return std::hypot(dot.x - arrow->middle.x, dot.y - arrow->middle.y) < kClear;
    };
    if (!arrow || std::any_of(dots.begin(), dots.end(), in_the_way)) continue;
    draw_arrow(page, *arrow, segment_colour(stretch.segment));
    return;
  }
}

void draw_dot(Svg& page, const PagePoint& at, const std::string& colour) {
  page.circle(at, 3, colour, {"#ffffff", 1});
}

void draw_start(Svg& page, const PagePoint& at, const std::string& colour) {
  page.circle(at, 7, "none", {"#ffffff", 4.6});
  page.circle(at, 7, "none", {colour, 2.2});
}

void draw_end(Svg& page, const PagePoint& at, const std::string& colour) {
  constexpr double kHalf = 4;
  const PageBox box{at.x - kHalf, at.y - kHalf, at.x + kHalf, at.y + kHalf};
  page.rectangle(box, colour);
  page.frame(box, {"#ffffff", 1.2});
}

// A segment without motion has no curve.  It is marked like an instant, whether or not one falls
// into it.
void draw_held_instants(Svg& page, const std::vector<Stretch>& stretches) {
  for (std::size_t k = 0; k < stretches.size(); ++k) {
    const int segment = stretches[k].segment;
    const bool alone = (k == 0 || stretches[k - 1].segment != segment) &&
                       (k + 1 == stretches.size() || stretches[k + 1].segment != segment);
    if (alone && length_of(stretches[k].points) < 1)
      draw_dot(page, stretches[k].points.back(), segment_colour(segment));
  }
}

}  // namespace

std::vector<RadiusMark> radius_marks(const Spacetime& spacetime) {
  if (spacetime.is<Wormhole>()) return {{1, "throat", false}};
  const auto hole = two_horizons(spacetime);
  std::vector<RadiusMark> marks;
  if (hole && !hole->is_naked() && !hole->is_extremal())
    marks.push_back({hole->inner_horizon(), "inner horizon", true});
  if (spacetime.horizon() > 0) marks.push_back({spacetime.horizon(), "horizon", true});
  if (const auto* spinning = std::get_if<SpinningHole>(&spacetime.kind())) {
    for (const bool prograde : {true, false})
      marks.push_back({kerr_light_circle(spinning->kerr, prograde),
                       prograde ? "light with it" : "light against it", false});
    return marks;
  }
  if (spacetime.light_circle() > 0)
    marks.push_back({spacetime.light_circle(), "light circle", false});
  return marks;
}

const char* unit_of(const Spacetime& spacetime) {
  return spacetime.is<Wormhole>() ? "radii of the throat" : "M";
}

std::string segment_colour(int segment) {
  // These are Okabe and Ito's colours, which the colour-blind can tell apart too, darkened for
  // white paper.
  static constexpr std::array kColours{"#0072b2", "#d55e00", "#00876a", "#b5508c",
                                       "#b07d00", "#2f95c8", "#7a5bb5", "#7c4a1e"};
  return kColours[static_cast<std::size_t>(segment) % kColours.size()];
}

void draw_heading(Svg& page, const PageBox& box, const std::string& text) {
  page.text({box.left, box.top - 14}, text, {16, "#1b1e24", "start", true});
}

void draw_path(Svg& page, const Path& path, const PlaceOnPage& place,
               bool (*joined)(const PathPoint&, const PathPoint&)) {
  const std::vector<Stretch> stretches = stretches_of(path, place, joined);
  for (const Stretch& s : stretches) page.curve(s.points, {"#ffffff", kWidth + 2.4});
  for (const Stretch& s : stretches)
    page.curve(s.points, {segment_colour(s.segment), kWidth, dashes_of(s.region)});
  std::vector<PagePoint> dots;
  for (const PathPoint& p : path.instants) dots.push_back(place(p));
  int arrow_of = -1;
  for (const Stretch& s : stretches) {
    if (s.segment == arrow_of || length_of(s.points) < kShortestWithArrow) continue;
    add_arrow(page, s, dots);
    arrow_of = s.segment;
  }
  draw_held_instants(page, stretches);
  for (std::size_t i = 0; i < dots.size(); ++i)
    draw_dot(page, dots[i], segment_colour(path.instants[i].segment));
  const PathPoint &first = path.points.front(), &last = path.points.back();
  draw_end(page, place(last), segment_colour(last.segment));
  draw_start(page, place(first), segment_colour(first.segment));
}

void draw_key(Svg& page, const PagePoint& at, const Path& path) {
  const std::string colour = "#30343c";
  const double y = at.y - 4.5;
  draw_start(page, {at.x + 8, y}, colour);
  page.text({at.x + 21, at.y}, "start");
  draw_end(page, {at.x + 77, y}, colour);
  page.text({at.x + 87, at.y}, "end");
  draw_dot(page, {at.x + 134, y}, colour);
  page.text({at.x + 143, at.y}, fmt::format("every {} s", number_text(path.instant_step_s)));
  double x = at.x + 245;
  for (const Region region : {Region::kIII, Region::kIV}) {
    bool visited = false;
    for (const PathPoint& p : path.points)
      visited |= p.region == region || (region == Region::kIII && p.region == Region::kVI);
    if (!visited) continue;
    page.line({x, y}, {x + 34, y}, {colour, kWidth, dashes_of(region)});
    page.text({x + 41, at.y}, fmt::format("in region {}", region_name(region)));
    x += 150;
  }
}

}  // namespace domefall
