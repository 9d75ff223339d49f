// `domefall report` measures the errors and the costs of rays, places, orbits and frames.  A Report
// holds its results, and the functions below write them as tables, plots and pages.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/report/frame_costs.h"
#include "pipeline/report/frame_errors.h"
#include "pipeline/report/orbit_errors.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/position_errors.h"
#include "pipeline/report/ray_errors.h"

namespace domefall {

struct Report {
  bool quick = false;
  std::vector<RayErrorRow> rays;
  std::vector<ViewRaySpeedRow> view_rays;
  std::vector<PositionErrorRow> positions;
  PositionSpeed position_speed{};
  std::vector<FrameErrorRow> frames;
  FrameCosts costs;
  std::vector<OrbitErrorRow> orbits;
  std::string extremes;  // from extreme_table(); empty if quick
};

// Measures on one thread, except for the errors of frames, which use all threads.  Calls `progress`
// with the name of each measurement as it begins.  This takes 18 s of CPU time if quick, else 7
// minutes.  Throws InputError if a shipped asset cannot be read.
Report measure_report(bool quick, const std::function<void(const std::string&)>& progress);

// Timings compare only within one machine, so the pages say on which one they were measured.
struct Machine {
  std::string processor;  // its model, as the system calls it
  unsigned cores;         // logical processors, as the system counts them
  std::string compiler;
  std::string version;  // of Domefall
  std::string date;     // of today, in UTC
};
Machine this_machine();
std::string machine_table();  // in Markdown

// Returns a table in CSV, with a line of column names and one line for each row.  The columns are
// the members of the row's structure.
std::string csv_of(const std::vector<RayErrorRow>& rows);
std::string csv_of(const std::vector<PositionErrorRow>& rows);
std::string csv_of(const std::vector<FrameErrorRow>& rows);
std::string csv_of(const std::vector<OrbitErrorRow>& rows);
// Returns the rows of both series in one table, in which the column `against` names the series.
// The benchmark is not in this table: its rows are FrameErrorRows, for which there is a function
// above.
std::string csv_of(const FrameCosts& costs);

// Returns the plots of error against time.  A plot of the azimuth is named rays_REGION_DIFFICULTY,
// and _sky is appended for the error on the sky.  The plots of frames are frames_rms and
// frames_worst, and every orbit that is also integrated has a plot orbit_NAME.
std::vector<NamedPlot> error_plots(const Report& report);

// Returns the plots of cost against size, which are named costs_stars and costs_pixels.
std::vector<NamedPlot> cost_plots(const FrameCosts& costs);

// Returns the curves of [Riazuelo]'s figures, from the tables that frames are rendered with.
// Each plot is named by the LaTeX label of its figure.  fig_dev, dev_III, dev_wh_0 and dev_wh show
// the deviation function phi_infinity(delta) for delta from 0 to 2 pi.  It has the paper's sign: in
// flat space phi_infinity = delta - pi.  So the function is minus the swept azimuth for delta < pi,
// and it is odd about pi.  fig_IV_dev shows the swept azimuth with the sign of L, as the paper
// does.  fig_delta_ee shows which sky is seen at which angle from the front, against r.
std::vector<NamedPlot> paper_curves();

// Returns the text of docs/accuracy.md, which links to the plots in plots/ and to the figures in
// figures/.
std::string accuracy_page(const Report& report, const std::vector<NamedPlot>& plots,
                          const std::vector<NamedPlot>& figures);

// Returns the text of docs/costs.md, which links to the two plots of costs in plots/.
std::string costs_page(const Report& report);

}  // namespace domefall
