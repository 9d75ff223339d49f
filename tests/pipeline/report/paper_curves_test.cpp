#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>

#include "pipeline/report/report.h"

namespace domefall {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

const Plot& curves_of(const std::vector<NamedPlot>& figures, std::string_view name) {
  return std::ranges::find_if(figures, [&](const NamedPlot& f) { return f.name == name; })->plot;
}

const PlotCurve& curve_of(const Plot& plot, std::string_view name) {
  return *std::ranges::find_if(plot.curves, [&](const PlotCurve& c) { return c.name == name; });
}

double near(const PlotCurve& curve, double x) {
  return std::ranges::min_element(curve.points,
                                  [&](const PlotPoint& a, const PlotPoint& b) {
                                    return std::abs(a.x - x) < std::abs(b.x - x);
                                  })
      ->y;
}

TEST(Figures, AreThoseOfThePaperAndEveryPointIsFinite) {
  const std::vector<NamedPlot> figures = paper_curves();
  std::vector<std::string> names;
  for (const NamedPlot& figure : figures) {
    names.push_back(figure.name);
    for (const PlotCurve& curve : figure.plot.curves)
      for (const PlotPoint& p : curve.points)
        EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << figure.name << " " << curve.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"fig_dev", "dev_III", "dev_wh_0", "dev_wh",
                                             "fig_IV_dev", "fig_delta_ee"}));
}

TEST(Figures, TheDeviationVanishesBehindAndPassesFiveHalfTurns) {
  const auto figures = paper_curves();
  const PlotCurve& curve = curve_of(curves_of(figures, "fig_dev"), "φ_∞(δ)");
  EXPECT_NEAR(near(curve, kHalfTurn), 0, 1e-8);
  EXPECT_LT(curve.points.front().y, -5.25 * kHalfTurn);
  // Far from the hole the curve differs from delta - pi by little more than aberration.
  EXPECT_NEAR(near(curve, 3),
              (3 - kHalfTurn) * std::sqrt((1 - std::sqrt(2 / 30.)) / (1 + std::sqrt(2 / 30.))),
              0.02);
}

TEST(Figures, RegionFourAtOneMTurnsWhereTheEnergyVanishes) {
  const auto figures = paper_curves();
  const PlotCurve& curve = curve_of(curves_of(figures, "dev_wh"), "region IV");
  double most = -1e300;
  for (const PlotPoint& p : curve.points) most = std::max(most, p.y);
  EXPECT_NEAR(most, -(2 * kHalfTurn - kHalfTurn / 2), 1e-4);  // a turn less arcsin(0) + pi/2
}

TEST(Figures, RegionFourFromWithinReachesTheArcsine) {
  const auto figures = paper_curves();
  const Plot& plot = curves_of(figures, "fig_IV_dev");
  EXPECT_NEAR(near(curve_of(plot, "r = 0.2 M"), kHalfTurn / 2), std::asin(-0.8) + kHalfTurn / 2,
              1e-6);
  EXPECT_NEAR(near(curve_of(plot, "r = 1.998 M"), kHalfTurn / 2), std::asin(0.998) + kHalfTurn / 2,
              1e-6);
}

TEST(Plots, AreDrawnAsSvg) {
  for (const NamedPlot& figure : paper_curves()) {
    const std::string svg = draw(figure.plot);
    EXPECT_EQ(svg.rfind("<?xml", 0), 0U) << figure.name;
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_GT(svg.size(), 5000U);
  }
}

TEST(Plots, LeaveOutWhatALogarithmCannotShow) {
  Plot plot;
  plot.y.scale = Axis::Scale::kLog;
  plot.curves = {{"a \"quoted\" name", {{1, 0}, {2, 1e-5}, {3, -1}, {4, NAN}}, 0}};
  const std::string script = gnuplot_script(plot);
  EXPECT_NE(script.find("$c0 << EOD\n2 1e-05\nEOD"), std::string::npos) << script;
  EXPECT_NE(script.find("'a \"quoted\" name'"), std::string::npos);
}

TEST(Plots, TextsAreNoScript) {
  for (const char* text :
       {"`touch ran`", "a'b", "x' ; system 'touch ran", "@ran", "a\\n\"b\nset"}) {
    Plot plot;
    plot.title = plot.x.label = text;
    plot.labels = {{1, 1, text}};
    plot.curves = {{text, {{1, 1}, {2, 2}}}};
    EXPECT_FALSE(draw(plot).empty()) << text;
    EXPECT_FALSE(std::filesystem::exists("ran")) << text;
  }
}

TEST(Plots, AFaultyScriptIsToldInTheWordsOfGnuplot) {
  EXPECT_THROW(run_gnuplot("plot nonsense_variable\n"), std::runtime_error);
  EXPECT_EQ(gnuplot_version().rfind("gnuplot ", 0), 0U);
}

}  // namespace
}  // namespace domefall
