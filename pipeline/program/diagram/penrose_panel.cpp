#include <fmt/core.h>

#include <cmath>

#include "pipeline/program/diagram/draw_panels.h"

namespace domefall {
namespace {

class Diagram {
 public:
  explicit Diagram(const PageBox& box)
      : x_{-1, 1, box.left, box.right}, up_{-0.5, 0.5, box.bottom, box.top} {}

  PagePoint operator()(const PenrosePoint& p) const { return {x_(p.x), up_(p.up)}; }
  PagePoint operator()(double x, double up) const { return {x_(x), up_(up)}; }

 private:
  Scale x_, up_;
};

// Draws a curve of constant r from corner to corner.  t = 12 artanh(part) at even parts of (-1, 1)
// spreads the points along it.
void draw_constant_radius(Svg& page, const Diagram& at, Region region, double r,
                          const Stroke& stroke) {
  constexpr int kSteps = 160;
  std::vector<PagePoint> points;
  for (int i = 1; i < kSteps; ++i) {
    const double part = 2.0 * i / kSteps - 1;
    points.push_back(at(penrose_point(region, 12 * std::atanh(part), r)));
  }
  page.curve(points, stroke);
}

// Writes r where the curve has t = 0.
void label_radius(Svg& page, const Diagram& at, Region region, double r) {
  const PagePoint p = at(penrose_point(region, 0, r));
  page.text({p.x, p.y + 3.5}, number_text(r), {10, "#7d8594", "middle", false, false, true});
}

void draw_radii(Svg& page, const Diagram& at) {
  const Stroke light{"#d3d8e1", 1}, circle{"#8d94a1", 1.1, "5 4"};
  for (const Region region : {Region::kI, Region::kIII})
    for (const double r : {2.1, 2.5, 3.0, 4.0, 6.0, 10.0})
      draw_constant_radius(page, at, region, r, r == 3 ? circle : light);
  for (const Region region : {Region::kII, Region::kIV})
    for (const double r : {1.0, 1.5, 1.9}) draw_constant_radius(page, at, region, r, light);
  for (const double r : {2.1, 2.5, 3.0, 4.0, 6.0}) label_radius(page, at, Region::kIII, r);
  for (const double r : {1.5, 1.9}) label_radius(page, at, Region::kIV, r);
}

void draw_singularity(Svg& page, const Diagram& at, double up) {
  constexpr int kTeeth = 48;
  constexpr double kHeight = 3;  // pixels
  std::vector<PagePoint> points;
  for (int i = 0; i <= kTeeth; ++i) {
    PagePoint p = at(-0.5 + static_cast<double>(i) / kTeeth, up);
    const bool end = i == 0 || i == kTeeth;
    p.y += end ? 0 : (i % 2 == 0 ? kHeight : -kHeight);
    points.push_back(p);
  }
  page.curve(points, {"#a02020", 1.6});
}

void draw_ground(Svg& page, const Diagram& at) {
  page.area({at(-0.5, 0.5), at(0.5, 0.5), at(0, 0)}, "#f1f2f5");
  page.area({at(-0.5, -0.5), at(0.5, -0.5), at(0, 0)}, "#f1f2f5");
  const TextStyle region{36, "#c9ced8", "middle", true};
  page.text({at(0.36, 0).x, at(0.36, 0).y + 12}, "I", region);
  page.text({at(-0.36, 0).x, at(-0.36, 0).y + 12}, "III", region);
  page.text({at(0, 0.31).x, at(0, 0.31).y + 12}, "II", region);
  page.text({at(0, -0.31).x, at(0, -0.31).y + 12}, "IV", region);
}

void draw_borders(Svg& page, const Diagram& at) {
  const Stroke border{"#30343c", 1.3}, horizon{"#16181d", 1.6};
  for (const double side : {-1.0, 1.0}) {
    page.curve({at(side * 0.5, 0.5), at(side, 0), at(side * 0.5, -0.5)}, border);
    page.line(at(-0.5 * side, -0.5), at(0.5 * side, 0.5), horizon);
  }
  draw_singularity(page, at, 0.5);
  draw_singularity(page, at, -0.5);
}

void draw_names(Svg& page, const Diagram& at) {
  for (const double side : {-1.0, 1.0}) {
    const char* outwards = side > 0 ? "start" : "end";
    const TextStyle corner{15, "#30343c", outwards, false, true};
    const auto beside = [&](double x, double up, double dx, double dy) {
      const PagePoint p = at(side * x, up);
      return PagePoint{p.x + side * dx, p.y + dy};
    };
    page.text(beside(0.5, 0.5, 9, -6), "i\u207a", corner);
    page.text(beside(0.5, -0.5, 9, 16), "i\u207b", corner);
    page.text(beside(1, 0, 8, 5), "i\u2070", corner);
    page.text(beside(0.75, 0.25, 9, -6), "\u2110\u207a", {16, "#30343c", outwards});
    page.text(beside(0.75, -0.25, 9, 16), "\u2110\u207b", {16, "#30343c", outwards});
  }
  const TextStyle singular{12, "#a02020", "middle"};
  page.text({at(0, 0.5).x, at(0, 0.5).y - 10}, "r = 0, singularity", singular);
  page.text({at(0, -0.5).x, at(0, -0.5).y + 20}, "r = 0, past singularity", singular);
  TextStyle horizon{11, "#30343c", "middle", false, false, true, 45};
  const PagePoint right = at(0.33, -0.33), left = at(-0.33, -0.33);
  page.text({right.x + 9, right.y - 9}, "r = 2", horizon);
  horizon.turned_deg = -45;
  page.text({left.x - 9, left.y - 9}, "r = 2", horizon);
}

const char* reason_of(Origin::Centre centre) {
  if (centre == Origin::Centre::kMiddle) return "the middle of the show lies at t = 0.";
  if (centre == Origin::Centre::kCrossing) return "a horizon is crossed at the middle of its line.";
  return "the crossings of both horizons lie symmetrically.";
}

}  // namespace

std::string origin_note(const Path& path, const char* unit) {
  const Origin& first = path.origins.front();
  for (const Origin& other : path.origins)
    if (other.time_shift != first.time_shift)
      return "The origin of t is free: after each jump it is chosen anew, so that a crossing or "
             "the "
             "middle is central.";
  return fmt::format("The origin of t is free: it is chosen (t shifted by {} {}) so that {}",
                     number_text(first.time_shift), unit, reason_of(first.centre));
}

PlaceOnPage draw_penrose_panel(Svg& page, const PageBox& box, const Path& path) {
  const Diagram at(box);
  page.text({box.left, box.top - 54}, "Carter\u2013Penrose diagram",
            {16, "#1b1e24", "start", true});
  page.begin_group("penrose");
  draw_ground(page, at);
  draw_radii(page, at);
  draw_borders(page, at);
  draw_names(page, at);
  PlaceOnPage place = [at](const PathPoint& p) { return at(p.penrose); };
  draw_path(page, path, place, is_joined);
  page.text({box.left, box.bottom + 52},
            "The whole spacetime, the future up; light runs at 45\u00b0. Grey: constant r (M).",
            {12, "#5a606c"});
  page.text({box.left, box.bottom + 70}, origin_note(path, "M"), {12, "#5a606c"});
  page.end_group();
  return place;
}

}  // namespace domefall
