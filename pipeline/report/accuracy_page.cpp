#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "pipeline/report/report.h"
#include "pipeline/report/text.h"

// The page is a text with named places, accuracy_page.inc.  What its words rest on:
//
// A picture shows the error on the sky and not that of phi.  Towards an edge phi = -ln x + c at the
// distance x (sky_table.h), so its slope is 1/x, and an error of phi displaces a ray by x times
// that.  An integrator must tell b < b_c from b > b_c by the steps that it takes.  So it finds the
// wrong origin, or none, where its errors are larger than the distance to the edge.
//
// The error of a time cannot be relative to the time alone, because a null time is counted from the
// observer and begins at 0.  So it is in units of max(1 M, the time).
//
// Two times of falls follow from formulas.  The rain falls by dr/dtau = -sqrt(2/r), so (sqrt 2/3)
// r^(3/2) is left at r.  With an angular momentum L the term 2 L^2/r^3 of the radial speed's square
// (reference_orbit.h) outweighs all others near the centre.  Then dr/dtau = -sqrt(2) L r^(-3/2), and
// r^(5/2)/(2.5 sqrt(2) L) is left.  A double between 64 and 128 is rounded by up to 7e-15.  Divided
// by the times left, 1.5e-5 and 2.3e-9, this moves r by 2/3 and 2/5 of the quotient, a relative
// 3e-10 and 1e-6.

namespace domefall {
namespace {

constexpr const char* kAccuracyText =
#include "pipeline/report/accuracy_page.inc"
    ;

// Returns the setting of a row in the words of the page.  That of a table is the number of bits, so
// 2^bits intervals divide an octave (octave_curve.h), and that of an integrator is the tolerance of
// a step.  The exact integral has none, which its setting 0 says.
std::string setting_of(const RayErrorRow& row) {
  if (row.method == "table") return fmt::format("2^{:g} to the octave", row.setting);
  return tolerance_text(row.setting);
}

bool is_of(const RayErrorRow& row, const RayClass& of) {
  return row.region == of.region && row.difficulty == of.name;
}

// Returns the values of a column over all classes of rays, at the method's default setting.
std::vector<double> defaults_of(const std::vector<RayErrorRow>& rows, const std::string& method,
                                double RayErrorRow::*value) {
  std::vector<double> values;
  for (const RayErrorRow& row : rows)
    if (row.method == method && row.is_default) values.push_back(row.*value);
  return values;
}

double worst_of(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

// The times of a ray are means over the classes, so that each class weighs as much as any other.
double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Returns the part on one class of rays, with every method at its default setting.  The other
// settings are points in the plots and rows of rays.csv.
std::string class_text(const std::vector<RayErrorRow>& rows, const RayClass& of) {
  const std::string table = lines_of(rows, [&](const RayErrorRow& r) {
    if (!is_of(r, of) || !r.is_default) return std::string();
    return table_line(r.method, setting_of(r), error_text(r.phi_99), error_text(r.phi_worst),
                      error_text(r.sky_99), error_text(r.sky_worst),
                      fmt::format("{} of {}", r.undecided, r.rays), amount(r.ns_per_ray),
                      r.build_us > 0 ? amount(r.build_us) : "");
  });
  const bool spin = of.kind == RayKind::kSpin;
  return fmt::format(
      "### Seen from {3}, {1}\n\n"
      "| method | setting | {4}, 99 of 100 | {4}, worst | sky, 99 of 100 | sky, worst | undecided "
      "| "
      "ns per ray | building, µs |\n|---|---|---|---|---|---|---|---|---|\n{2}\n"
      "![error of the {5} against time](plots/rays_{0}_{1}.svg)\n"
      "![error on the sky against time](plots/rays_{0}_{1}_sky.svg)\n\n",
      of.region, of.name, table, place_of(of), spin ? "place" : "φ", spin ? "place" : "azimuth");
}

// Returns the quickest way to an error on the sky that 99 of 100 rays of a class keep while none is
// undecided.  Of each method the quickest setting that will do counts, and the settings of a method
// go from coarse to fine, so that is the first of them.
std::string quickest(const std::vector<RayErrorRow>& rows, const RayClass& of, double wanted) {
  const RayErrorRow* best = nullptr;
  std::string seen;
  for (const RayErrorRow& r : rows) {
    if (!is_of(r, of) || r.undecided > 0 || r.sky_99 > wanted || r.method == seen) continue;
    seen = r.method;
    if (best == nullptr || r.ns_per_ray < best->ns_per_ray) best = &r;
  }
  if (best == nullptr) return "none";
  const std::string setting = setting_of(*best);
  return fmt::format("{}{}, {} ns", best->method,
                     setting.empty() ? "" : fmt::format(" ({})", setting),
                     amount(best->ns_per_ray));
}

// Compares another setting with the default of its scene.  Its error and its time are given in
// units of the default's.  Geometric means over the scenes suit ratios, of which 2 and 1/2 must
// balance.
std::string compared(const std::vector<FrameErrorRow>& rows, const std::string& other) {
  double log_rms = 0, log_time = 0;
  int scenes = 0;
  for (const FrameErrorRow& row : rows)
    for (const FrameErrorRow& usual : rows) {
      const bool is_pair = row.setting == other && usual.scene == row.scene &&
                           usual.setting.find("default") != std::string::npos;
      if (!is_pair) continue;
      log_rms += std::log(row.rms / usual.rms);
      log_time += std::log(row.copies / usual.copies);
      ++scenes;
    }
  if (scenes == 0) return "";
  return fmt::format("* {}: {:.2f} times its error in {:.2f} times its time\n", other,
                     std::exp(log_rms / scenes), std::exp(log_time / scenes));
}

// Returns one line for each setting that is not the default, in the order of the rows.
std::string compared_settings(const std::vector<FrameErrorRow>& rows) {
  std::set<std::string> seen;
  return lines_of(rows, [&](const FrameErrorRow& row) {
    const bool is_usual = row.setting.find("default") != std::string::npos;
    return !is_usual && seen.insert(row.setting).second ? compared(rows, row.setting) : "";
  });
}

std::string place_line(const PositionErrorRow& r) {
  return table_line(r.at_edge ? "edge" : "others", r.method, tolerance_text(r.tolerance), r.places,
                    r.missing, error_text(r.r.worst), error_text(r.r.most),
                    error_text(r.time.worst), error_text(r.time.most), amount(r.ns_per_place));
}

std::string frame_line(const FrameErrorRow& r) {
  return table_line(r.scene, r.size, r.setting, error_text(r.rms), amount(r.worst),
                    amount(r.seconds), amount(r.copies));
}

std::string orbit_line(const OrbitErrorRow& r) {
  return table_line(r.orbit, r.method, tolerance_text(r.tolerance), error_text(r.r_error),
                    error_text(r.phi_error), error_text(r.energy_drift),
                    error_text(r.angular_momentum_drift), error_text(r.norm_drift),
                    fmt::format("{:.2g}", r.seconds));
}

std::string orbit_plot_line(const NamedPlot& plot) {
  if (!plot.name.starts_with("orbit_")) return "";
  return fmt::format("![error against time](plots/{}.svg)\n", plot.name);
}

std::string extremes_part(const std::string& table) {
  if (table.empty()) return "";
  return "## Where something diverges\n\nThese are stiff and extreme cases, and the tests hold "
         "each to its bound. In the column *what happens* the\ncounts, the light and the errors "
         "were measured; sizes of skies and holes, and distances of images, follow from "
         "formulas.\n\n" +
         table + "\n";
}

std::string curves_part(const std::vector<NamedPlot>& figures) {
  if (figures.empty()) return "";
  return "## The curves of the paper\n\nThese are the figures of A. Riazuelo, *Seeing relativity "
         "I*, whose files are named by their LaTeX labels. They\nare drawn from the tables that "
         "frames are rendered with.\n\n" +
         lines_of(figures,
                  [](const NamedPlot& figure) {
                    return fmt::format("![{}](figures/{}.svg)\n", figure.plot.title, figure.name);
                  }) +
         "\n";
}

// Returns the line of a class in the table of the quickest methods for three errors (radians).  The
// largest, 1e-6, is 1/380 of a pixel of an 8k dome, which is pi/8192.  The others say what a method
// takes for more than any picture shows.
std::string quickest_line(const std::vector<RayErrorRow>& rows, const RayClass& of) {
  return table_line(fmt::format("{}, {}", place_of(of), of.name), quickest(rows, of, 1e-6),
                    quickest(rows, of, 1e-9), quickest(rows, of, 1e-12));
}

}  // namespace

std::string accuracy_page(const Report& report, const std::vector<NamedPlot>& plots,
                          const std::vector<NamedPlot>& figures) {
  constexpr double kPixel8k = std::numbers::pi / 8192;  // a dome shows pi radians across
  const auto& rays = report.rays;
  const PositionSpeed& speed = report.position_speed;
  const double sky = worst_of(defaults_of(rays, "table", &RayErrorRow::sky_worst));
  return fmt::format(
      fmt::runtime(kAccuracyText), fmt::arg("quick", report.quick ? " --quick" : ""),
      fmt::arg("machine", machine_table()), fmt::arg("intervals", 1 << OctaveCurve::kPerOctaveBits),
      fmt::arg("sky", error_text(sky)), fmt::arg("pixels", error_text(sky / kPixel8k)),
      fmt::arg("ns", amount(mean_of(defaults_of(rays, "table", &RayErrorRow::ns_per_ray)))),
      fmt::arg("exact_ns", amount(mean_of(defaults_of(rays, "exact", &RayErrorRow::ns_per_ray)))),
      fmt::arg("build_us", amount(worst_of(defaults_of(rays, "table", &RayErrorRow::build_us)))),
      fmt::arg("view_rays", lines_of(report.view_rays,
                                     [](const ViewRaySpeedRow& r) {
                                       return table_line(r.from, fmt::format("{:.1f}", r.ns));
                                     })),
      fmt::arg("quickest", lines_of(ray_classes(),
                                    [&](const RayClass& of) { return quickest_line(rays, of); })),
      fmt::arg("classes",
               lines_of(ray_classes(), [&](const RayClass& of) { return class_text(rays, of); })),
      fmt::arg("ray", speed.ray), fmt::arg("place", speed.place),
      fmt::arg("ray_time", speed.ray_time), fmt::arg("place_time", speed.place_time),
      fmt::arg("places", lines_of(report.positions, place_line)),
      fmt::arg("frames", lines_of(report.frames, frame_line)),
      fmt::arg("settings", compared_settings(report.frames)),
      fmt::arg("orbits", lines_of(report.orbits, orbit_line)),
      fmt::arg("orbit_plots", lines_of(plots, orbit_plot_line)),
      fmt::arg("extremes", extremes_part(report.extremes)),
      fmt::arg("curves", curves_part(figures)), fmt::arg("gnuplot", gnuplot_version()));
}

}  // namespace domefall
