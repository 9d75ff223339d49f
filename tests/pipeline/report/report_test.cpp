#include "pipeline/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/report/machine.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

Report small_report() {
  Report report;
  report.quick = true;
  report.rays = {{"I", "ordinary", "table", 3, true, 9, 0, 2e-10, 1e-10, 3e-10, 1e-10, 300, 400},
                 {"I", "ordinary", "exact", 0, true, 9, 0, 0, 0, 0, 0, 1700, 0},
                 {"I", "ordinary", "slow", 1e-6, true, 9, 1, 1e-6, 1e-6, 1e-6, 1e-6, 200, 0}};
  report.frames = {{"a scene, with a comma", "1 look", 64, 0.01, 0.5, 2, 40},
                   {"a scene, with a comma", "many", 64, 0.001, 0.1, 1, 20},
                   {"a scene, with a comma", "many everywhere", 64, 0.0005, 0.1, 3, 60}};
  report.orbits = {{"round", "closed form", 0, 0, 0, 0, 1e-16, 1e-12, 1e-5},
                   {"round", "steps", 1e-6, 1e-7, 1e-7, 1e-7, 1e-6, 1e-5, 1e-2},
                   {"at rest", "closed form", 0, 0, 0, 0, 0, 0, 1e-5}};
  return report;
}

const Plot& plot_of(const std::vector<Figure>& plots, const std::string& name) {
  const auto found = std::find_if(plots.begin(), plots.end(),
                                  [&](const Figure& plot) { return plot.name == name; });
  EXPECT_NE(found, plots.end()) << name;
  return found->plot;
}

TEST(ReportTables, HaveACellForEveryName) {
  const Report report = small_report();
  EXPECT_EQ(csv_of(report.frames),
            "scene,setting,size,rms,worst,seconds,copies\n"
            "\"a scene, with a comma\",1 look,64,0.01,0.5,2,40\n"
            "\"a scene, with a comma\",many,64,0.001,0.1,1,20\n"
            "\"a scene, with a comma\",many everywhere,64,0.0005,0.1,3,60\n");
  const std::string rays = csv_of(report.rays), orbits = csv_of(report.orbits);
  for (const std::string& csv : {rays, orbits}) {
    const auto names = std::count(csv.begin(), csv.begin() + csv.find('\n'), ',');
    const auto lines = std::count(csv.begin(), csv.end(), '\n');
    EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), names * lines);
  }
}

TEST(ReportTables, NamesOfFilesAreMadeOfOrbits) {
  EXPECT_EQ(slug("Circular, at 3.1 M (unstable)"), "circular-at-3-1-m-unstable");
  EXPECT_EQ(csv_cell("say \"so\""), "\"say \"\"so\"\"\"");
}

TEST(ErrorPlots, HaveOneCurveForEveryMethod) {
  const std::vector<Figure> plots = error_plots(small_report());
  const Plot& rays = plot_of(plots, "rays_I_ordinary");
  ASSERT_EQ(rays.curves.size(), 3U);
  EXPECT_EQ(rays.curves[0].name, "table");
  EXPECT_DOUBLE_EQ(rays.curves[0].points.at(0).x, 0.3);  // µs
  EXPECT_GT(rays.curves[1].points.at(0).y, 0);           // no error at all can still be drawn
  const Plot& frames = plot_of(plots, "frames_rms");
  ASSERT_EQ(frames.curves.size(), 2U);
  EXPECT_EQ(frames.curves[0].points.size(), 2U);
  EXPECT_EQ(frames.curves[1].style, Curve::Style::kDashed);
  EXPECT_EQ(plot_of(plots, "orbit_round").curves.size(), 2U);
  EXPECT_TRUE(std::none_of(plots.begin(), plots.end(),
                           [](const Figure& plot) { return plot.name == "orbit_at-rest"; }));
}

TEST(AccuracyPage, NamesTheMachineAndTheQuickestSoundWay) {
  const Report report = small_report();
  const std::string page = accuracy_page(report, error_plots(report), {});
  const Machine on = this_machine();
  for (const std::string& fact : {on.processor, on.compiler, on.date})
    EXPECT_NE(page.find(fact), std::string::npos) << fact;
  // The quicker method has lost a ray.
  EXPECT_NE(page.find("| I, ordinary | table (2^3 to the octave), 300 ns | table (2^3 to the "
                      "octave), 300 ns | exact, 1700 ns |"),
            std::string::npos)
      << page;
  EXPECT_EQ(page.find("extreme"), std::string::npos);
}

}  // namespace
}  // namespace domefall
