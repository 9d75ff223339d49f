#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/program/diagram/draw_panels.h"
#include "pipeline/spacetime/conformal.h"

namespace domefall {
namespace {

// An Extent is what is drawn of a diagram, in its own units.
struct Extent {
  double left, right, bottom, top;
};

const Stroke kBorder{"#30343c", 1.3};

// A Block is a region of one of the universes.
struct Block {
  Region region;
  int universe;
};

// Returns the blocks of all universes that a path visits.  Of the first one what lies before its
// outsides, and of the last what lies behind them, is left out where the path does not go there; but
// of a single one all that follows is drawn.  About a spin all ways end at the inner horizon.
std::vector<Block> blocks_of(const ChargedHole& hole, const Path& path, bool spins) {
  if (spins) return {{Region::kI, 0}, {Region::kIII, 0}, {Region::kII, 0}};
  if (hole.is_naked()) return {{Region::kI, 0}};
  const auto [first, last] = std::ranges::minmax(path.points, {}, &PathPoint::universe);
  const auto visits = [&path](int universe, auto... regions) {
    return std::ranges::any_of(path.points, [=](const PathPoint& p) {
      return p.universe == universe && ((p.region == regions) || ...);
    });
  };
  std::vector<Block> blocks;
  for (int n = first.universe; n <= last.universe; ++n) {
    using enum Region;
    blocks.push_back({kI, n});
    const bool goes_on = n < last.universe || n == first.universe || visits(n, kII, kV, kVI);
    if (goes_on) blocks.push_back({kV, n});
    if (hole.is_extremal()) continue;
    blocks.push_back({kIII, n});
    if (goes_on) blocks.insert(blocks.end(), {{kII, n}, {kVI, n}});
    if (n > first.universe || visits(n, kIV)) blocks.push_back({kIV, n});
  }
  return blocks;
}

// Returns the corners of a block.  Those of V are its middle, and the ends of the singularity.
std::vector<PenrosePoint> corners_of(const ChargedHole& hole, const Block& block) {
  const double up = block.universe * universe_height(hole);
  const auto diamond = [](double x, double y) {
    return std::vector<PenrosePoint>{{x, y - 0.5}, {x + 0.5, y}, {x, y + 0.5}, {x - 0.5, y}};
  };
  if (hole.is_naked()) return {{0.5, 0}, {0, 0.5}, {0, -0.5}};
  switch (block.region) {
    case Region::kI:
      return diamond(0.5, up);
    case Region::kIII:
      return diamond(-0.5, up);
    case Region::kII:
      return diamond(0, up + 0.5);
    case Region::kIV:
      return diamond(0, up - 0.5);
    case Region::kV:
      if (hole.is_extremal()) return {{0.5, up + 0.5}, {0, up + 1}, {0, up}};
      return {{0, up + 1}, {-0.5, up + 1.5}, {-0.5, up + 0.5}};
    case Region::kVI:
      break;
  }
  return {{0, up + 1}, {0.5, up + 1.5}, {0.5, up + 0.5}};
}

Extent extent_of(const Spacetime& spacetime, const Path& path) {
  const auto hole = two_horizons(spacetime);
  if (!hole) return {-1, 1, -1, 1};
  Extent extent{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
  for (const Block& block : blocks_of(*hole, path, spacetime.is<SpinningHole>()))
    for (const PenrosePoint& p : corners_of(*hole, block)) {
      extent.left = std::min(extent.left, p.x), extent.right = std::max(extent.right, p.x);
      extent.bottom = std::min(extent.bottom, p.up), extent.top = std::max(extent.top, p.up);
    }
  return extent;
}

// Draws the blocks of a spacetime, at the places that `at` gives their points.
template <class At>
class Blocks {
 public:
  Blocks(Svg& page, const At& at, double pixels) : page_(page), at_(at), pixels_(pixels) {}

  void wormhole(const Wormhole& w) {
    page_.curve({at_({0, -1}), at_({1, 0}), at_({0, 1}), at_({-1, 0}), at_({0, -1})}, kBorder);
    for (const double l : {1.0, 2.0, 4.0, 8.0})
      for (const double side : {-l, l})
        constant_radius([&](double t) { return penrose_point(w, t, side); });
    page_.line(at_({0, -1}), at_({0, 1}), {"#16181d", 1.2, "5 4"});
    name("I", {0.5, 0});
    name("III", {-0.5, 0});
  }

  void charged(const ChargedHole& hole, const Path& path, bool spins) {
    const std::vector<Block> blocks = blocks_of(hole, path, spins);
    for (const Block& b : blocks)
      if (b.region == Region::kII || b.region == Region::kIV) fill(corners_of(hole, b));
    for (const Block& b : blocks) {
      for (const double r : radii_of(hole, b.region)) {
        const bool mirrored = b.region == Region::kIII || b.region == Region::kVI;
        constant_radius([&](double t) {
          const PenrosePoint p =
              penrose_point(hole, mirrored ? mirror_of(b.region) : b.region, b.universe, t, r);
          return PenrosePoint{mirrored ? -p.x : p.x, p.up};
        });
      }
      edges(hole, b, b.universe == blocks.front().universe, spins);
      label(hole, b);
    }
  }

 private:
  static std::vector<double> radii_of(const ChargedHole& hole, Region region) {
    const double outer = hole.is_naked() ? 1 : hole.horizon(), inner = hole.inner_horizon();
    switch (region) {
      case Region::kI:
      case Region::kIII:
        if (hole.is_naked()) return {0.25, 0.5, 1, 2, 4, 8};
        return {1.1 * outer, 1.5 * outer, 3 * outer, 6 * outer};
      case Region::kV:
      case Region::kVI:
        return {0.5 * inner, 0.8 * inner, 0.95 * inner};
      default:
        return {std::lerp(inner, outer, 0.2), std::lerp(inner, outer, 0.5),
                std::lerp(inner, outer, 0.8)};
    }
  }

  void fill(const std::vector<PenrosePoint>& corners) {
    std::vector<PagePoint> points(corners.size());
    std::transform(corners.begin(), corners.end(), points.begin(), at_);
    page_.area(points, "#f1f2f5");
  }

  // `place` gives the point at a time.
  template <class Place>
  void constant_radius(const Place& place) {
    constexpr int kSteps = 160;
    constexpr double kTime = 4;  // M
    std::vector<PagePoint> points;
    for (int k = 1; k < kSteps; ++k)
      points.push_back(at_(place(kTime * std::tan((2.0 * k / kSteps - 1) * std::numbers::pi / 2))));
    page_.curve(points, {"#d3d8e1", 1});
  }

  // The edges of II and IV are those of the blocks beside them, but for the lower ones of a first IV.
  void edges(const ChargedHole& hole, const Block& block, bool is_first, bool ends) {
    const Stroke outer{"#16181d", 1.8}, inner{"#16181d", 1.4, "7 3"};
    const std::vector<PenrosePoint> c = corners_of(hole, block);
    // Draws the two edges that meet at a corner.
    const auto draw = [&](std::size_t corner, const Stroke& stroke) {
      for (const std::size_t step : {std::size_t{1}, c.size() - 1})
        page_.line(at_(c[corner]), at_(c[(corner + step) % c.size()]), stroke);
    };
    if (c.size() == 3) {
      draw(0, hole.is_naked() ? kBorder : hole.is_extremal() ? outer : inner);
      singularity(c[2], c[1]);
    } else if (is_outside(block.region)) {
      const bool right = block.region == Region::kI;
      draw(right ? 1 : 3, kBorder);
      draw(right ? 3 : 1, outer);
    } else if (block.region == Region::kIV && is_first) {
      draw(0, inner);
    } else if (ends) {
      draw(2, inner);
    }
  }

  void singularity(const PenrosePoint& from, const PenrosePoint& to) {
    constexpr int kTeeth = 40;
    constexpr double kHeight = 2.5;  // pixels
    std::vector<PagePoint> points;
    for (int k = 0; k <= kTeeth; ++k) {
      PagePoint p = at_({from.x, std::lerp(from.up, to.up, static_cast<double>(k) / kTeeth)});
      p.x += k == 0 || k == kTeeth ? 0 : k % 2 == 0 ? kHeight : -kHeight;
      points.push_back(p);
    }
    page_.curve(points, {"#a02020", 1.6});
  }

  void label(const ChargedHole& hole, const Block& block) {
    PenrosePoint middle{};
    const std::vector<PenrosePoint> corners = corners_of(hole, block);
    for (const PenrosePoint& p : corners) {
      middle.x += p.x / static_cast<double>(corners.size());
      middle.up += p.up / static_cast<double>(corners.size());
    }
    name(region_name(block.region, block.universe), middle);
  }

  void name(const std::string& text, const PenrosePoint& middle) {
    const double size = std::min(30.0, pixels_ * 0.13);
    const PagePoint p = at_(middle);
    page_.text({p.x, p.y + size / 3}, text, {size, "#b9bfca", "middle", true});
  }

  Svg& page_;
  const At& at_;
  double pixels_;  // of a unit of the diagram
};

std::string marks_note(const Spacetime& spacetime) {
  std::string note;
  const auto add = [&note](const std::string& text) { note += (note.empty() ? "" : "; ") + text; };
  for (const RadiusMark& mark : radius_marks(spacetime)) {
    if (!mark.is_horizon && !spacetime.is<Wormhole>()) continue;
    const bool dashed = !mark.is_horizon || mark.r < spacetime.horizon();
    add(fmt::format("{}: the {}, r = {}", dashed ? "dashed" : "heavy", mark.name,
                    number_text(mark.r)));
  }
  if (spacetime.is<SpinningHole>())
    add("what is within is not computed");
  else if (two_horizons(spacetime))
    add("red: the singularity, r = 0");
  note.front() = static_cast<char>(std::toupper(note.front()));
  return note + ".";
}

}  // namespace

PageBox blocks_box(const PagePoint& top_left, double width, const Spacetime& spacetime,
                   const Path& path) {
  constexpr double kMostHeight = 760, kLeastUnit = 60;  // pixels
  const Extent e = extent_of(spacetime, path);
  const double wide = e.right - e.left, high = e.top - e.bottom;
  const double unit = std::min(std::max(kMostHeight / high, kLeastUnit), width / wide);
  const double left = top_left.x + (width - unit * wide) / 2;
  return {left, top_left.y, left + unit * wide, top_left.y + unit * high};
}

PlaceOnPage draw_blocks_panel(Svg& page, const PageBox& box, const Spacetime& spacetime,
                              const Path& path) {
  const Extent extent = extent_of(spacetime, path);
  const Scale x{extent.left, extent.right, box.left, box.right},
      up{extent.bottom, extent.top, box.bottom, box.top};
  const auto at = [x, up](const PenrosePoint& p) { return PagePoint{x(p.x), up(p.up)}; };
  constexpr double kNotes = 620;  // the left of all texts
  page.text({kNotes, box.top - 54}, "Carter\u2013Penrose diagram", {16, "#1b1e24", "start", true});
  page.begin_group("penrose");
  Blocks blocks(page, at, x(1) - x(0));
  if (const auto hole = two_horizons(spacetime))
    blocks.charged(*hole, path, spacetime.is<SpinningHole>());
  else
    blocks.wormhole(std::get<Wormhole>(spacetime.kind()));
  PlaceOnPage place = [at](const PathPoint& p) { return at(p.penrose); };
  draw_path(page, path, place, is_joined);
  const std::string notes[] = {"The future is up; light runs at 45\u00b0. Grey: constant r.",
                               marks_note(spacetime), origin_note(path, unit_of(spacetime))};
  double y = box.bottom + 12;
  for (const std::string& note : notes) page.text({kNotes, y += 18}, note, {12, "#5a606c"});
  page.end_group();
  return place;
}

}  // namespace domefall
