#include "pipeline/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "pipeline/report/text.h"

namespace domefall {
namespace {

Report small_report() {
  Report report;
  report.quick = true;
  report.rays = {{"I", "ordinary", "table", 3, true, 9, 0, 2e-10, 1e-10, 3e-10, 1e-10, 300, 400},
                 {"I", "ordinary", "exact", 0, true, 9, 0, 0, 0, 0, 0, 1700, 0},
                 {"I", "ordinary", "slow", 1e-6, true, 9, 1, 1e-6, 1e-6, 1e-6, 1e-6, 200, 0}};
  report.frames = {{"a scene, with a comma", "1 view ray", 64, 0.01, 0.5, 2, 40},
                   {"a scene, with a comma", "many", 64, 0.001, 0.1, 1, 20},
                   {"a scene, with a comma", "many, none interpolated", 64, 0.001, 0.1, 2, 40},
                   {"a scene, with a comma", "many everywhere", 64, 0.0005, 0.1, 3, 60}};
  // The slopes are 100, 110 and 99 ns for each further star, and 20 and 10 ns for each further
  // pixel.
  report.costs.stars = {{"near", 64, 3e3, 1e3, 1e-3, 10},
                        {"near", 64, 3e3, 2e3, 1.1e-3, 11},
                        {"near", 64, 3e3, 12e3, 2.2e-3, 22},
                        {"far", 64, 3e3, 1e3, 1e-3, 10},
                        {"far", 64, 3e3, 2e3, 1.099e-3, 10.99}};
  report.costs.pixels = {{"sky", 64, 1e4, 0, 1e-3, 10},
                         {"sky", 128, 4e4, 0, 1.6e-3, 4},
                         {"sky", 256, 16e4, 0, 2.8e-3, 2}};
  report.costs.benchmark = {{"picture", "default", 100, 0.001, 0.1, 0.25, 50},
                            {"picture", "2 x 2 everywhere", 100, 0.002, 0.1, 0.5, 100}};
  report.orbits = {{"round", "closed form", 0, 0, 0, 0, 1e-16, 1e-12, 1e-5},
                   {"round", "steps", 1e-6, 1e-7, 1e-7, 1e-7, 1e-6, 1e-5, 1e-2},
                   {"at rest", "closed form", 0, 0, 0, 0, 0, 0, 1e-5}};
  return report;
}

const Plot& plot_of(const std::vector<NamedPlot>& plots, std::string_view name) {
  const auto found = std::find_if(plots.begin(), plots.end(),
                                  [&](const NamedPlot& plot) { return plot.name == name; });
  EXPECT_NE(found, plots.end()) << name;
  return found->plot;
}

TEST(ReportTables, HaveACellForEveryName) {
  const Report report = small_report();
  EXPECT_EQ(csv_of(report.frames),
            "scene,setting,size,rms,worst,seconds,copies\n"
            "\"a scene, with a comma\",1 view ray,64,0.01,0.5,2,40\n"
            "\"a scene, with a comma\",many,64,0.001,0.1,1,20\n"
            "\"a scene, with a comma\",\"many, none interpolated\",64,0.001,0.1,2,40\n"
            "\"a scene, with a comma\",many everywhere,64,0.0005,0.1,3,60\n");
  const std::string rays = csv_of(report.rays), orbits = csv_of(report.orbits);
  for (const std::string& csv : {rays, orbits}) {
    const auto names = std::count(csv.begin(), csv.begin() + csv.find('\n'), ',');
    const auto lines = std::count(csv.begin(), csv.end(), '\n');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), names * lines);
  }
}

TEST(ReportTables, TellWhatCostsAreMeasuredAgainst) {
  const std::string csv = csv_of(small_report().costs);
  EXPECT_EQ(csv.substr(0, csv.find("\nstars,near,64,3000,2000,")),
            "against,scene,size,pixels,stars,seconds,copies\n"
            "stars,near,64,3000,1000,0.001,10");
  EXPECT_NE(csv.find("\npixels,sky,256,160000,0,0.0028,2\n"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5 + 3);
}

TEST(ReportTables, NamesOfFilesAreMadeOfOrbits) {
  EXPECT_EQ(slug("Circular, at 3.1 M (unstable)"), "circular-at-3-1-m-unstable");
  EXPECT_EQ(csv_cell(std::string("say \"so\"")), "\"say \"\"so\"\"\"");
}

TEST(ErrorPlots, HaveOneCurveForEveryMethod) {
  const std::vector<NamedPlot> plots = error_plots(small_report());
  const Plot& rays = plot_of(plots, "rays_I_ordinary");
  ASSERT_EQ(rays.curves.size(), 3U);
  EXPECT_EQ(rays.curves[0].name, "table");
  EXPECT_DOUBLE_EQ(rays.curves[0].points.at(0).x, 0.3);  // µs
  EXPECT_GT(rays.curves[1].points.at(0).y, 0);           // an error of 0 can still be drawn
  const Plot& frames = plot_of(plots, "frames_rms");
  ASSERT_EQ(frames.curves.size(), 3U);
  EXPECT_EQ(frames.curves[0].points.size(), 1U);
  EXPECT_EQ(frames.curves[1].points.size(), 2U);  // one view ray is traced in every pixel
  EXPECT_EQ(frames.curves[1].style, PlotCurve::Style::kDashed);
  EXPECT_EQ(frames.curves[2].points.size(), 1U);
  EXPECT_EQ(frames.curves[2].colour, frames.curves[0].colour);
  EXPECT_EQ(plot_of(plots, "orbit_round").curves.size(), 2U);
  EXPECT_TRUE(std::none_of(plots.begin(), plots.end(),
                           [](const NamedPlot& plot) { return plot.name == "orbit_at-rest"; }));
}

TEST(CostPlots, HaveOneCurveForEveryScene) {
  const std::vector<NamedPlot> plots = cost_plots(small_report().costs);
  const Plot &stars = plot_of(plots, "costs_stars"), &pixels = plot_of(plots, "costs_pixels");
  ASSERT_EQ(stars.curves.size(), 2U);
  EXPECT_EQ(stars.curves[1].name, "far");
  EXPECT_DOUBLE_EQ(stars.curves[0].points.at(2).x, 12e3);
  EXPECT_DOUBLE_EQ(stars.curves[0].points.at(2).y, 2.2);  // ms
  ASSERT_EQ(pixels.curves.size(), 1U);
  EXPECT_DOUBLE_EQ(pixels.curves[0].points.at(2).x, 16e4);
}

// The numbers follow by hand from those of small_report.
TEST(CostsPage, StatesSlopesAndTheLargestRise) {
  const std::string page = costs_page(small_report());
  for (const char* fact :
       {"| near | 64 | 2000 | 1.1 | 11 | 367 | 100 |",
        "| near | 64 | 12000 | 2.2 | 22 | 733 | 110 |", "* near: 109 ns for each further star",
        "* far: 99 ns for each further star", "is 1.10** (near, at 2000 stars)",
        "* sky: 12 ns for each further pixel", "is 0.50** (sky, at 40000 pixels)",
        "| picture | 100 x 100 | 2 x 2 everywhere | 2.0e-03 | 0.1 | 500 | 100 |"})
    EXPECT_NE(page.find(fact), std::string::npos) << fact << "\n" << page;
}

TEST(CostsPage, ComparesWithTheQuickestGeodesicThatIsRightToAHundredthOfAPixel) {
  Report report = small_report();
  report.rays.push_back({"I", "ordinary", "rk4", 1e-4, false, 9, 0, 0, 0, 1, 1, 500, 0});
  report.rays.push_back({"I", "ordinary", "rk4", 1e-5, false, 9, 0, 0, 0, 1e-6, 1e-6, 1000, 0});
  report.rays.push_back({"I", "ordinary", "rk4", 1e-6, true, 9, 0, 0, 0, 1e-7, 1e-7, 2000, 0});
  report.view_rays = {{"here", 12.5}};
  const std::string page = costs_page(report);
  EXPECT_NE(page.find("1000 ns a ray"), std::string::npos) << page;
  EXPECT_NE(page.find("takes 17.5 ns: 57.1 times less"), std::string::npos) << page;
  EXPECT_NE(page.find("12.5 ns (here: 8 times less)"), std::string::npos) << page;
}

TEST(CostsPage, SaysWhereTheDefaultErrsMoreThanTwiceTheResolution) {
  Report report = small_report();
  report.frames = {{"a", "many (default)", 64, 0.002, 0.5, 2, 40},
                   {"a", "2 x 2 everywhere", 64, 0.004, 0.1, 4, 80},
                   {"b", "many (default)", 64, 0.003, 0.5, 2, 40},
                   {"b", "2 x 2 everywhere", 64, 0.002, 0.1, 4, 80}};
  const std::string page = costs_page(report);
  // The geometric mean of 1/2 and 3/2 is 0.87.
  EXPECT_NE(page.find("0.87 times its rms error in 0.50 times its time"), std::string::npos)
      << page;
  EXPECT_NE(page.find("in 1 of 2 scenes; the others, as times its error: b: 1.5."),
            std::string::npos)
      << page;
}

TEST(AccuracyPage, NamesTheMachineAndTheQuickestSoundWay) {
  const Report report = small_report();
  const std::string page = accuracy_page(report, error_plots(report), {});
  const Machine on = this_machine();
  for (const std::string& fact : {on.processor, on.compiler, on.date})
    EXPECT_NE(page.find(fact), std::string::npos) << fact;
  // The table is named, since the quicker method has lost a ray.
  EXPECT_NE(page.find("| region I, ordinary | table (2^3 to the octave), 300 ns | table (2^3 to "
                      "the octave), 300 ns | exact, 1700 ns |"),
            std::string::npos)
      << page;
  EXPECT_EQ(page.find("extreme"), std::string::npos);
}

}  // namespace
}  // namespace domefall
