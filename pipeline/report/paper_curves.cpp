#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/traced_ray.h"
#include "pipeline/report/report.h"

namespace domefall {
namespace {

constexpr double kPi = std::numbers::pi;

// An End bounds a part of the view: an edge between skies, where the azimuth diverges, or the axis.
struct End {
  double delta;
  std::optional<Edge> edge;
};

// Returns distances from an end.  Some are evenly spaced in their logarithm and some in themselves,
// so that the azimuth is drawn as a smooth curve whether it goes like a logarithm (next to an edge)
// or like a cube root (on the axis, for light from the past singularity).
std::vector<double> distances(double reach) {
  constexpr int kLog = 160, kEven = 120;
  // By phi = -ln x + c (sky_table.h) a curve has risen beyond kShown there, which the tests check
  // of fig_dev.
  constexpr double kLeast = 1e-9;
  std::vector<double> d;
  d.reserve(kLog + kEven);
  for (int k = 0; k < kLog; ++k) d.push_back(kLeast * std::pow(reach / kLeast, k / (kLog - 1.0)));
  for (int k = 1; k < kEven; ++k) d.push_back(reach * k / kEven);
  std::sort(d.begin(), d.end());
  return d;
}

// Returns the swept azimuth against delta between two ends of the view.  Each half of the curve is
// traced by offsets from its own end, so that its rays are exact next to an edge.
std::vector<PlotPoint> sweep(TraceObserver observer, double r, const End& low, const End& high) {
  const auto azimuth = [&](const End& end, double offset) {
    RayRequest q{observer, r, end.delta + offset, end.edge, offset};
    return PlotPoint{end.delta + offset, trace_ray(q, TraceMethod::kTable).phi};
  };
  std::vector<double> d = distances((high.delta - low.delta) / 2);
  std::vector<PlotPoint> points;
  points.reserve(2 * d.size());
  for (const double from_low : d) points.push_back(azimuth(low, from_low));
  std::reverse(d.begin(), d.end());
  for (const double from_high : d) points.push_back(azimuth(high, -from_high));
  return points;
}

// Returns the deviation function for sign -1, and the azimuth with the sign of L for sign +1.
std::vector<PlotPoint> signed_curve(const std::vector<PlotPoint>& swept, double sign) {
  std::vector<PlotPoint> points = swept;
  for (PlotPoint& p : points) p.y *= sign;
  return points;
}

// Continues a curve from [0, pi] to [pi, 2 pi].  The function is odd about pi, so delta becomes
// 2 pi - delta, and the azimuth changes its sign.
std::vector<PlotPoint> continued(const std::vector<PlotPoint>& points) {
  std::vector<PlotPoint> other;
  other.reserve(points.size());
  for (const PlotPoint& p : points) other.push_back({2 * kPi - p.x, -p.y});
  std::reverse(other.begin(), other.end());
  return other;
}

// Adds a curve from 0 to pi and its continuation to 2 pi under one name.
void add_deviation(Plot& plot, const std::string& name, int colour,
                   const std::vector<PlotPoint>& points) {
  plot.curves.push_back({name, points, colour, PlotCurve::Style::kLine});
  plot.curves.push_back({"", continued(points), colour, PlotCurve::Style::kLine});
}

Plot deviation_plot(const std::string& title, double turns) {
  return {.title = title,
          .x = {"angle of the view ray from the hole, δ", Axis::Scale::kOfPi, 0, 2 * kPi, 1.0 / 4},
          .y = {"origin of the light, φ_∞", Axis::Scale::kOfPi, -turns * kPi, turns * kPi, 1},
          .legend = "top left"};
}

constexpr int kColourOne = 0, kColourThree = 1, kColourFour = 2, kColourFlat = 6;
// The range is that of the paper, "slightly larger than 5 pi", by [Riazuelo] fig. fig_dev.
constexpr double kShown = 5.25;  // the largest |phi| that is drawn, in units of pi

End edge_of(double r, Edge edge) { return {edge_delta(TraceObserver::kRain, r, edge), edge}; }
constexpr End kFront{0, std::nullopt}, kBack{kPi, std::nullopt};

struct Regions {
  bool one = true, three = false, four = false;
};

// Returns the deviation functions of the regions that rain sees at r, from the front to the back:
// region III up to its edge, region IV between the edges, and region I beyond the silhouette.
Plot rain_plot(const std::string& title, double r, const Regions& seen) {
  Plot plot = deviation_plot(title, kShown);
  const auto add = [&](const char* name, int colour, const End& low, const End& high) {
    add_deviation(plot, name, colour, signed_curve(sweep(TraceObserver::kRain, r, low, high), -1));
  };
  const End silhouette = edge_of(r, Edge::kSilhouette);
  if (seen.one) add("region I", kColourOne, silhouette, kBack);
  if (seen.three) add("region III", kColourThree, kFront, edge_of(r, Edge::kRegionThree));
  if (seen.four)
    add("region IV", kColourFour, seen.three ? edge_of(r, Edge::kRegionThree) : kFront, silhouette);
  return plot;
}

// At 30 M the deviation function is compared with a ray that is neither bent nor aberrated.
Plot deviation_far_away() {
  Plot plot = rain_plot("Deviation function, free fall at r = 30 M", 30, {});
  plot.curves.front().name = "φ_∞(δ)";
  plot.curves.push_back({"δ − π: neither bent nor aberrated",
                         {{0, -kPi}, {2 * kPi, kPi}},
                         kColourFlat,
                         PlotCurve::Style::kDashed});
  return plot;
}

// The four radii are those of [Riazuelo] fig. fig_IV_dev and fig_IV_img.  The azimuth of an
// observer at rest in t is largest at E = 0, arcsin(r - 1) + pi/2, which stays below pi, so 1.1 pi
// is enough of an axis.
Plot white_hole_from_within() {
  Plot plot = deviation_plot("Region IV seen from region IV, at rest in t", 1.1);
  plot.x.label = "angle of the view ray from −∂_t, δ";
  plot.y.label = "origin of the light, Δφ";
  plot.y.mark_every = 1.0 / 4;
  plot.legend = "top right";
  int colour = 0;
  for (const double r : {0.001, 0.2, 1.7, 1.998}) {
    add_deviation(plot, fmt::format("r = {:g} M", r), colour++,
                  signed_curve(sweep(TraceObserver::kFour, r, kFront, kBack), 1));
  }
  return plot;
}

// Returns the angle of an edge, in degrees, against r.  For small r the numerators of both edges
// are near 3 sqrt(6/r) and the denominator is near 3 sqrt(3) sqrt(2/r), so tan(delta/2) tends to 1.
// The angle changes from there like sqrt(r), so the radii grow like the squares of evenly spaced
// numbers.
std::vector<PlotPoint> edge_curve(Edge edge, double r_end) {
  constexpr int kPoints = 400;
  constexpr double kDegrees = 180 / kPi, kRight = 90;
  std::vector<PlotPoint> points{{0, kRight}};  // both edges tend to this at the singularity
  for (int k = 1; k <= kPoints; ++k) {
    const double part = static_cast<double>(k) / kPoints, r = r_end * part * part;
    points.push_back({r, edge_delta(TraceObserver::kRain, r, edge) * kDegrees});
  }
  return points;
}

std::vector<PlotPoint> closed(std::vector<PlotPoint> points,
                              const std::vector<PlotPoint>& corners) {
  points.insert(points.end(), corners.begin(), corners.end());
  return points;
}

Plot what_is_seen() {
  constexpr double kFar = 10, kHorizon = 2, kAll = 180;
  const std::vector<PlotPoint> silhouette = edge_curve(Edge::kSilhouette, kFar);
  const std::vector<PlotPoint> third = edge_curve(Edge::kRegionThree, kHorizon);
  // The dark area lies between the edges: out along the silhouette, back along the axis to the
  // horizon, and inwards along the edge of region III.
  std::vector<PlotPoint> dark = silhouette;
  dark.push_back({kFar, 0});
  dark.insert(dark.end(), third.rbegin(), third.rend());
  return {
      .title = "What the free faller sees, from rest at infinity",
      .x = {"r/M", Axis::Scale::kLinear, 0, kFar, 1},
      .y = {"angle from the front, degrees", Axis::Scale::kLinear, 0, kAll, 30},
      .curves = {{"", closed(silhouette, {{kFar, kAll}, {0, kAll}}), kColourOne,
                  PlotCurve::Style::kArea},
                 {"", dark, kColourFlat, PlotCurve::Style::kArea},
                 {"", closed(third, {{0, 0}}), kColourThree, PlotCurve::Style::kArea},
                 {"", silhouette, kColourOne, PlotCurve::Style::kLine},
                 {"", third, kColourThree, PlotCurve::Style::kLine},
                 {"", {{kHorizon, 0}, {kHorizon, kAll}}, kColourFlat, PlotCurve::Style::kDotted}},
      .labels = {{6, 120, "region I"},
                 {4.1, 14, "silhouette (past singularity)"},
                 {0.7, 25, "region III"},
                 {2.6, 170, "horizon"}},
      .legend = ""};
}

}  // namespace

std::vector<NamedPlot> paper_curves() {
  return {
      {"fig_dev", deviation_far_away()},
      {"dev_III", rain_plot("Free fall at r = M: regions I and III", 1, {true, true, false})},
      {"dev_wh_0", rain_plot("Free fall at r = 20 M: regions I and IV", 20, {true, false, true})},
      {"dev_wh", rain_plot("Free fall at r = M: regions I, III and IV", 1, {true, true, true})},
      {"fig_IV_dev", white_hole_from_within()},
      {"fig_delta_ee", what_is_seen()}};
}

}  // namespace domefall
