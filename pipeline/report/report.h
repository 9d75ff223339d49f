// Everything that `domefall report` measures, and how it is written down.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/report/frame_costs.h"
#include "pipeline/report/frame_errors.h"
#include "pipeline/report/orbit_errors.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/ray_errors.h"
#include "pipeline/report/view_ray_speed.h"

namespace domefall {

struct Report {
  bool quick = false;
  std::vector<RayErrorRow> rays;
  std::vector<ViewRaySpeedRow> view_rays;
  std::vector<FrameErrorRow> frames;
  FrameCosts costs;
  std::vector<OrbitErrorRow> orbits;
  std::string extremes;  // extreme_table(); empty if quick
};

// One thread but for the errors of frames.  told: what is being measured, as it begins.  Measured:
// quick 18 s of CPU time, else 7 minutes.  Throws InputError if a shipped asset cannot be read.
Report measure_report(bool quick, const std::function<void(const std::string&)>& told);

// One line of names, one for each row; the columns are the members of the rows' structures.
std::string csv_of(const std::vector<RayErrorRow>& rows);
std::string csv_of(const std::vector<FrameErrorRow>& rows);
std::string csv_of(const std::vector<OrbitErrorRow>& rows);
// The rows of both series; `against` names which.  The benchmark's are rows of frames.
std::string csv_of(const FrameCosts& costs);

// Error against time: rays_REGION_DIFFICULTY and the same with _sky, frames_rms, frames_worst, and
// orbit_NAME of every orbit that is integrated as well.
std::vector<NamedPlot> error_plots(const Report& report);

// Cost against size: costs_stars and costs_pixels.
std::vector<NamedPlot> cost_plots(const FrameCosts& costs);

// The page, in Markdown.  `figures`: those drawn beside it, under figures/; the plots under plots/.
std::string accuracy_page(const Report& report, const std::vector<NamedPlot>& plots,
                          const std::vector<NamedPlot>& figures);

// The page about costs, in Markdown, with the two plots under plots/.
std::string costs_page(const Report& report);

}  // namespace domefall
