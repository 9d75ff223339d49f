// Everything that `domefall report` measures, and the files that it is written to.
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
#include "pipeline/report/view_ray_speed.h"

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

// Measures on one thread, but for the errors of frames.  `progress` is called with the name of each
// measurement as it begins.  It takes 18 s of CPU time if quick, else 7 minutes.  Throws InputError
// if a shipped asset cannot be read.
Report measure_report(bool quick, const std::function<void(const std::string&)>& progress);

// One line of names and one line for each row.  The columns are the members of the row's structure.
std::string csv_of(const std::vector<RayErrorRow>& rows);
std::string csv_of(const std::vector<PositionErrorRow>& rows);
std::string csv_of(const std::vector<FrameErrorRow>& rows);
std::string csv_of(const std::vector<OrbitErrorRow>& rows);
// The rows of both series, which the column `against` names.  The benchmark's rows are written as
// rows of frames.
std::string csv_of(const FrameCosts& costs);

// Plots of error against time.  Their names are rays_REGION_DIFFICULTY for the azimuth, the same
// with _sky for the error on the sky, frames_rms and frames_worst, and orbit_NAME for every orbit
// that is integrated as well.
std::vector<NamedPlot> error_plots(const Report& report);

// Plots of cost against size, named costs_stars and costs_pixels.
std::vector<NamedPlot> cost_plots(const FrameCosts& costs);

// docs/accuracy.md.  It links to the plots in plots/ and to the figures in figures/.
std::string accuracy_page(const Report& report, const std::vector<NamedPlot>& plots,
                          const std::vector<NamedPlot>& figures);

// docs/costs.md.  It links to the two plots in plots/.
std::string costs_page(const Report& report);

}  // namespace domefall
