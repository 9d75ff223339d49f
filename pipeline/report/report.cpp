#include "pipeline/report/report.h"

#include <fmt/chrono.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

// Linux describes every logical processor by lines of the form "model name : ...".  The first one
// counts.
std::string processor_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown processor";
}

// clang defines __VERSION__ as well, so it is asked for first.
constexpr const char* kCompiler =
#if defined(__clang__)
    "clang " __clang_version__;
#else
    "g++ " __VERSION__;
#endif

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

std::string extreme_table() {
  std::string table =
      "| case | tried | what happens | worst | of | bound |\n|---|---|---|---|---|---|\n";
  for (const auto& list : {extreme_rays(), extreme_swept(), extreme_spins(), extreme_frames()})
    for (const ExtremeCase& c : list) {
      // The tests call the same function, so they and the page cannot tell different things.
      const ExtremeResult result = c.measure();
      table += table_line(c.name, c.tried, result.outcome, fmt::format("{:.2g}", result.worst),
                          c.quantity, fmt::format("{:.2g}", c.bound));
    }
  return table;
}

std::string machine_table() {
  const Machine on = this_machine();
  return fmt::format(
      "| | |\n|---|---|\n"
      "| processor | {}, {} cores |\n| compiler | {} |\n| Domefall | {} |\n| date | {} |\n\n",
      on.processor, on.cores, on.compiler, on.version, on.date);
}

Machine this_machine() {
  return {processor_model(), std::thread::hardware_concurrency(), kCompiler, DOMEFALL_VERSION,
          fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))};
}

std::string csv_of(const std::vector<RayErrorRow>& rows) {
  return "region,difficulty,method,setting,is_default,rays,undecided,phi_worst,phi_99,sky_worst,"
         "sky_99,ns_per_ray,build_us\n" +
         lines_of(rows, [](const RayErrorRow& r) {
           return csv_line(r.region, r.difficulty, r.method, r.setting, int{r.is_default}, r.rays,
                           r.undecided, r.phi_worst, r.phi_99, r.sky_worst, r.sky_99, r.ns_per_ray,
                           r.build_us);
         });
}

std::string csv_of(const std::vector<PositionErrorRow>& rows) {
  return "rays,method,tolerance,places,missing,r_worst,r_99,time_worst,time_99,ns_per_place\n" +
         lines_of(rows, [](const PositionErrorRow& r) {
           return csv_line(r.at_edge ? "edge" : "others", r.method, r.tolerance, r.places,
                           r.missing, r.r.worst, r.r.most, r.time.worst, r.time.most,
                           r.ns_per_place);
         });
}

std::string csv_of(const std::vector<FrameErrorRow>& rows) {
  return "scene,setting,size,rms,worst,seconds,copies\n" +
         lines_of(rows, [](const FrameErrorRow& r) {
           return csv_line(r.scene, r.setting, r.size, r.rms, r.worst, r.seconds, r.copies);
         });
}

// Pixels and stars are whole numbers of up to eight digits, which six significant digits would
// round.
std::string csv_of(const FrameCosts& costs) {
  const auto line = [](const char* against, const FrameCostRow& r) {
    return csv_line(against, r.scene, r.size, fmt::format("{:.0f}", r.pixels),
                    fmt::format("{:.0f}", r.stars), r.seconds, r.copies);
  };
  return "against,scene,size,pixels,stars,seconds,copies\n" +
         lines_of(costs.stars, [&](const FrameCostRow& r) { return line("stars", r); }) +
         lines_of(costs.pixels, [&](const FrameCostRow& r) { return line("pixels", r); });
}

std::string csv_of(const std::vector<OrbitErrorRow>& rows) {
  return "orbit,method,tolerance,energy_drift,angular_momentum_drift,norm_drift,r_error,phi_error,"
         "seconds\n" +
         lines_of(rows, [](const OrbitErrorRow& r) {
           return csv_line(r.orbit, r.method, r.tolerance, r.energy_drift, r.angular_momentum_drift,
                           r.norm_drift, r.r_error, r.phi_error, r.seconds);
         });
}

}  // namespace domefall
