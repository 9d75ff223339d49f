#include "pipeline/report/report.h"

#include <fmt/format.h>

#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + csv_cell(cell);
  return line + "\n";
}

// Returns a number with six significant digits, so that a table shows more than the pages do.
std::string n(double value) { return fmt::format("{:.6g}", value); }

}  // namespace

Report measure_report(bool quick, const std::function<void(const std::string&)>& progress) {
  Report report;
  report.quick = quick;
  progress("orbits");
  report.orbits = measure_orbits(quick);
  progress("rays");
  report.rays = measure_rays(quick);
  report.view_rays = measure_view_ray_speed();
  progress("places along rays");
  report.positions = measure_positions(quick);
  report.position_speed = measure_position_speed();
  progress("frames");
  report.frames = measure_frames(quick);
  progress("costs of frames");
  report.costs = measure_frame_costs(quick);
  // The tests hold the same cases to their bounds, so a quick report can do without them.
  if (!quick) {
    progress("extreme cases");
    report.extremes = extreme_table();
  }
  return report;
}

std::string csv_of(const std::vector<RayErrorRow>& rows) {
  std::string csv =
      "region,difficulty,method,setting,is_default,rays,undecided,phi_worst,phi_99,sky_worst,"
      "sky_99,ns_per_ray,build_us\n";
  for (const RayErrorRow& r : rows)
    csv += csv_line({r.region, r.difficulty, r.method, n(r.setting), r.is_default ? "1" : "0",
                     fmt::to_string(r.rays), fmt::to_string(r.undecided), n(r.phi_worst),
                     n(r.phi_99), n(r.sky_worst), n(r.sky_99), n(r.ns_per_ray), n(r.build_us)});
  return csv;
}

std::string csv_of(const std::vector<PositionErrorRow>& rows) {
  std::string csv =
      "rays,method,tolerance,places,missing,r_worst,r_99,time_worst,time_99,ns_per_place\n";
  for (const PositionErrorRow& r : rows)
    csv += csv_line({r.at_edge ? "edge" : "others", r.method, n(r.tolerance),
                     fmt::to_string(r.places), fmt::to_string(r.missing), n(r.r.worst), n(r.r.most),
                     n(r.time.worst), n(r.time.most), n(r.ns_per_place)});
  return csv;
}

std::string csv_of(const std::vector<FrameErrorRow>& rows) {
  std::string csv = "scene,setting,size,rms,worst,seconds,copies\n";
  for (const FrameErrorRow& r : rows)
    csv += csv_line({r.scene, r.setting, fmt::to_string(r.size), n(r.rms), n(r.worst), n(r.seconds),
                     n(r.copies)});
  return csv;
}

// Pixels and stars are whole numbers of up to eight digits, which six significant digits would
// round.
std::string csv_of(const FrameCosts& costs) {
  std::string csv = "against,scene,size,pixels,stars,seconds,copies\n";
  const auto add = [&](const char* against, const std::vector<FrameCostRow>& rows) {
    for (const FrameCostRow& r : rows)
      csv += csv_line({against, r.scene, fmt::to_string(r.size), fmt::format("{:.0f}", r.pixels),
                       fmt::format("{:.0f}", r.stars), n(r.seconds), n(r.copies)});
  };
  add("stars", costs.stars), add("pixels", costs.pixels);
  return csv;
}

std::string csv_of(const std::vector<OrbitErrorRow>& rows) {
  std::string csv =
      "orbit,method,tolerance,energy_drift,angular_momentum_drift,norm_drift,r_error,phi_error,"
      "seconds\n";
  for (const OrbitErrorRow& r : rows)
    csv +=
        csv_line({r.orbit, r.method, n(r.tolerance), n(r.energy_drift), n(r.angular_momentum_drift),
                  n(r.norm_drift), n(r.r_error), n(r.phi_error), n(r.seconds)});
  return csv;
}

}  // namespace domefall
