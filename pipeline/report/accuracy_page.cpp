#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "pipeline/report/gnuplot.h"
#include "pipeline/report/machine.h"
#include "pipeline/report/report.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

// Returns an error with two significant digits, which show its power of ten and a little more.
std::string error(double value) { return fmt::format("{:.1e}", value); }

// Returns the setting of a row in the words of the page.  That of a table is the number of bits, so
// 2^bits intervals divide an octave (octave_curve.h), and that of an integrator is the tolerance of
// a step.  The exact integral has none, which its setting 0 says.
std::string setting_of(const RayErrorRow& row) {
  if (row.method == "table") return fmt::format("2^{:g} to the octave", row.setting);
  return row.setting > 0 ? fmt::format("{:.0e}", row.setting) : "";
}

// Returns the beginning of the page.  Some numbers in the sentences below are not results, such as
// the ranges of rays, so the page says first which of them a further run would measure anew.
std::string head(const Report& report) {
  return fmt::format(
      "# Accuracy, and what it costs\n\n"
      "`domefall report{}` made this page. That run measured all errors, drifts, counts and times. "
      "It did not\nmeasure the numbers that say what was tried: ranges, sizes, tolerances and "
      "digits. The bounds are those of the\ntests. A sentence that takes a number from a formula "
      "or from a test says so.\n\n{}"
      "Times are of one machine on one day, and compare within the page; the errors are the "
      "same\neverywhere. All rows are in [rays.csv](rays.csv), [positions.csv](positions.csv), "
      "[frames.csv](frames.csv) and\n[orbits.csv](orbits.csv). [costs.md](costs.md) says what a "
      "frame costs by its stars and pixels, and compares it\nwith other ways to make it.\n\n",
      report.quick ? " --quick" : "", machine_table());
}

// ---- Rays ----

// The ranges are those of ray_samples.h, which says what the classes are.  A picture shows the
// error on the sky and not that of phi.  Towards an edge phi = -ln x + c at the distance x
// (sky_table.h), so its slope is 1/x, and an error of phi displaces a ray by x times that.
//
// An integrator must tell b < b_c from b > b_c by the steps that it takes.  So it finds the wrong
// origin, or none, where its errors are larger than the distance to the edge.
constexpr const char* kRaysMeasured =
    "## Rays\n\n"
    "Random rays of all observers, with a fixed seed, are each compared with the same ray in "
    "100-digit arithmetic\n(`pipeline/report/reference/reference_ray.h`). *Ordinary* rays reach "
    "observers from 0.1 to 100 M at any angle.\n*Edge* rays lie 1e-12 to 1e-3 radians beside an "
    "edge between skies. *Deep* rays reach observers from 1e-6 to\n0.1 M, and *far* rays those "
    "from 1e3 to 1e8 M. The error of the azimuth φ is relative to max(1, φ). The error\non the "
    "sky is the same error as an angle at the observer, |error of φ|/|dφ/dδ|, in radians. A ray is "
    "undecided\nif a method finds no azimuth, or another origin than the true one; such rays are "
    "not in the errors.\n\n"
    "The integrators start from E, L and k^r in double precision and find where a ray ends by "
    "getting there.\nBeside an edge their tolerance must be finer than the ray's distance from it, "
    "or they lose the ray.\nThe times of *table* and *exact* are for azimuth and slope, those of "
    "the integrators for the azimuth alone.\nThe time of *table* is of one ray by itself, with all "
    "that leads to the look-up. A table, once built, serves all\nrays of its radius, and frames "
    "trace 128 view rays at a time.\n\n"
    "*rk4* is the paper's own method, adaptive in Schwarzschild and Kruskal coordinates. *dopri5* "
    "and *rkf78*\nintegrate the same equations by Dormand-Prince 5(4) and Fehlberg 7(8), "
    "and *binet-dopri5* and *binet-rkf78*\nintegrate the orbit's equation by the same two.\n\n";

// Returns the largest value of a column over all classes of rays, at the method's default setting.
double worst_of(const std::vector<RayErrorRow>& rows, const std::string& method,
                double RayErrorRow::*value) {
  double worst = 0;
  for (const RayErrorRow& row : rows)
    if (row.method == method && row.is_default) worst = std::max(worst, row.*value);
  return worst;
}

// Returns the mean of a column over the same rows.
double mean_of(const std::vector<RayErrorRow>& rows, const std::string& method,
               double RayErrorRow::*value) {
  double sum = 0;
  int count = 0;
  for (const RayErrorRow& row : rows)
    if (row.method == method && row.is_default) sum += row.*value, ++count;
  return count > 0 ? sum / count : 0;
}

// Returns what the page says of the default.  The worst error counts, and so does the slowest
// building of tables.  The times of a ray are means over the classes, so that each class weighs as
// much as any other.
std::string default_of_rays(const std::vector<RayErrorRow>& rows) {
  constexpr double kPixel8k = std::numbers::pi / 8192;  // a dome shows pi radians across
  const double sky = worst_of(rows, "table", &RayErrorRow::sky_worst);
  const double ns = mean_of(rows, "table", &RayErrorRow::ns_per_ray);
  const double exact_ns = mean_of(rows, "exact", &RayErrorRow::ns_per_ray);
  return fmt::format(
      "**The default is the table with {} intervals to the octave.** Its worst displacement on the "
      "sky over all these rays\nis {} radians, {} of a pixel of an 8k dome. One ray takes {} ns, "
      "by the "
      "exact integral {} ns; the tables of one radius are built in {} µs, the most of any class "
      "(median over its radii).\nFiner tables cost the same for each ray, and coarser ones save "
      "little in building, as rays.csv shows.\n\n",
      1 << OctaveCurve::kPerOctaveBits, error(sky), error(sky / kPixel8k), amount(ns),
      amount(exact_ns), amount(worst_of(rows, "table", &RayErrorRow::build_us)));
}

// Returns the table of one class of rays, by every method at its default setting.  The other
// settings are points in the plots and rows of rays.csv.
std::string class_table(const std::vector<RayErrorRow>& rows, const RayClass& of) {
  std::string table =
      "| method | setting | φ, 99 of 100 | φ, worst | sky, 99 of 100 | sky, worst | undecided | "
      "ns per ray | building, µs |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const RayErrorRow& r : rows) {
    if (r.region != of.region || r.difficulty != of.name || !r.is_default) continue;
    table += fmt::format("| {} | {} | {} | {} | {} | {} | {} of {} | {} | {} |\n", r.method,
                         setting_of(r), error(r.phi_99), error(r.phi_worst), error(r.sky_99),
                         error(r.sky_worst), r.undecided, r.rays, amount(r.ns_per_ray),
                         r.build_us > 0 ? amount(r.build_us) : "");
  }
  return table + "\n";
}

// Returns the quickest method whose displacement on the sky is at most `wanted` for 99 of 100 rays,
// with none undecided.  Each method competes with its coarsest setting that will do.  The rows of a
// method go from coarse to fine, so that is the first of them.
std::string quickest(const std::vector<RayErrorRow>& rows, const RayClass& of, double wanted) {
  const RayErrorRow* best = nullptr;
  std::string seen;
  for (const RayErrorRow& r : rows) {
    const bool will_do = r.region == of.region && r.difficulty == of.name && r.undecided == 0 &&
                         r.sky_99 <= wanted && r.method != seen;
    if (!will_do) continue;
    seen = r.method;
    if (best == nullptr || r.ns_per_ray < best->ns_per_ray) best = &r;
  }
  if (best == nullptr) return "none";
  const std::string setting = setting_of(*best);
  return fmt::format("{}{}, {} ns", best->method,
                     setting.empty() ? "" : fmt::format(" ({})", setting),
                     amount(best->ns_per_ray));
}

// Returns the quickest methods for three errors (radians).  The largest, 1e-6, is 1/380 of a pixel
// of an 8k dome, which is pi/8192.  The others say what a method takes for more than any picture
// shows.
std::string quickest_table(const std::vector<RayErrorRow>& rows) {
  constexpr std::array kWanted{1e-6, 1e-9, 1e-12};
  std::string table =
      "If the table is at hand, this is the quickest way to an error on the sky (99 of 100 rays, "
      "none undecided):\n\n| rays | 1e-6 | 1e-9 | 1e-12 |\n|---|---|---|---|\n";
  for (const RayClass& of : ray_classes()) {
    table += fmt::format("| {}, {}", of.region, of.name);
    for (const double wanted : kWanted) table += " | " + quickest(rows, of, wanted);
    table += " |\n";
  }
  return table + "\n";
}

// Returns the times of measure_view_ray_speed().  They are shorter than those of a table in the
// other lists, because SIMD code takes many rays together (view_tracer.h).
std::string view_rays(const std::vector<ViewRaySpeedRow>& rows) {
  std::string page =
      "In a frame, where 128 view rays are traced together, this is the time of one of them on one "
      "thread, from the\npixel's direction to the place on the sky, with aberration, redshift and "
      "footprint:\n\n"
      "| observer | ns per view ray |\n|---|---|\n";
  for (const ViewRaySpeedRow& row : rows)
    page += fmt::format("| {} | {:.1f} |\n", row.from, row.ns);
  return page + "\n";
}

std::string rays(const Report& report) {
  std::string page = kRaysMeasured + default_of_rays(report.rays) + view_rays(report.view_rays) +
                     quickest_table(report.rays);
  for (const RayClass& of : ray_classes()) {
    page += fmt::format(
        "### Seen from region {0}, {1}\n\n{2}"
        "![error of the azimuth against time](plots/rays_{0}_{1}.svg)\n"
        "![error on the sky against time](plots/rays_{0}_{1}_sky.svg)\n\n",
        of.region, of.name, class_table(report.rays, of));
  }
  return page;
}

// ---- Places along rays ----

// Returns the part on places.  The error of a time cannot be relative to the time alone, because a
// null time is counted from the observer and begins at 0.  So it is in units of max(1 M, the time).
std::string places(const Report& report) {
  const PositionSpeed& speed = report.position_speed;
  std::string page = fmt::format(
      "## Places along rays\n\n"
      "This compares where rays of all these classes are on their way, between 0.02 and 0.98 of "
      "the azimuth that they\nsweep, and when their light was there, with the orbit's equation "
      "in 50 digits\n(`pipeline/report/reference/reference_position.h`). *exact* and *table* find "
      "the place by its angle from an\nend of the orbit, by functions that double with the angle, "
      "and the time by one function; *table* is what renders:\nin a frame 128 rays are taken at a "
      "time, {:.0f} ns "
      "for what\nstays the same along a ray and {:.0f} ns for a place, and for the time of light's "
      "flight {:.0f} and {:.0f} ns more.\nNothing is built for a radius. Times are null "
      "coordinates "
      "(v, or u in the outgoing frame); their errors count in M,\nor in the time itself where that "
      "is more.\n\n"
      "| rays | method | tolerance | places | missing | r, worst, relative | r, 99 of 100 | time, "
      "worst | time, 99 of 100 | ns "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n",
      speed.ray, speed.place, speed.ray_time, speed.place_time);
  for (const PositionErrorRow& r : report.positions)
    page += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
                        r.at_edge ? "edge" : "others", r.method,
                        r.tolerance > 0 ? fmt::format("{:.0e}", r.tolerance) : "", r.places,
                        r.missing, error(r.r.worst), error(r.r.most), error(r.time.worst),
                        error(r.time.most), amount(r.ns_per_place));
  return page + "\n";
}

// ---- Frames and orbits ----

// Returns the first row of a scene whose setting contains these words, or null.
const FrameErrorRow* row_of(const std::vector<FrameErrorRow>& rows, const std::string& scene,
                            const std::string& part_of_setting) {
  for (const FrameErrorRow& row : rows)
    if (row.scene == scene && row.setting.find(part_of_setting) != std::string::npos) return &row;
  return nullptr;
}

// Compares another setting with the default.  Its error and its time are given in units of the
// default's.  Geometric means over the scenes suit ratios, of which 2 and 1/2 must balance.
std::string compared(const std::vector<FrameErrorRow>& rows, const std::string& other) {
  double log_rms = 0, log_time = 0;
  int scenes = 0;
  for (const FrameErrorRow& row : rows) {
    const FrameErrorRow* usual = row_of(rows, row.scene, "default");
    if (row.setting != other || usual == nullptr) continue;
    log_rms += std::log(row.rms / usual->rms);
    log_time += std::log(row.copies / usual->copies);
    ++scenes;
  }
  if (scenes == 0) return "";
  return fmt::format("* {}: {:.2f} times its error in {:.2f} times its time\n", other,
                     std::exp(log_rms / scenes), std::exp(log_time / scenes));
}

// Returns one line for each setting that is not the default, in the order of the rows.
std::string default_of_frames(const std::vector<FrameErrorRow>& rows) {
  std::string text =
      "\n**The default is 4 x 4 view rays in difficult pixels**, through which an edge between "
      "skies runs or\nwhose footprint on the sky is long and narrow. The other settings compare "
      "with it as follows, by geometric\nmeans over the scenes:\n\n";
  std::set<std::string> seen;
  for (const FrameErrorRow& row : rows)
    if (row.setting.find("default") == std::string::npos && seen.insert(row.setting).second)
      text += compared(rows, row.setting);
  return text + "\n";
}

// Returns the part on frames.  frame_errors.h says why graded frames are compared, and not the
// light itself.
std::string frames(const std::vector<FrameErrorRow>& rows) {
  std::string page =
      "## Frames\n\nWhole frames with each setting of anti-aliasing are compared with frames of "
      "256 view rays in every pixel. Both\nare graded as they go to the projector, to values from "
      "0 to 1, of which one step of 8 bits is 1/255 = 0.0039.\nTime is CPU time of rendering, in "
      "seconds and in copies of the frame's own memory. Where the view of a map is\nsmooth, the "
      "default interpolates most view rays between those of a coarse grid; *none interpolated* "
      "and\n*everywhere* trace them in every pixel.\n\n"
      "| scene | pixels | setting | rms | worst | s | copies |\n|---|---|---|---|---|---|---|\n";
  for (const FrameErrorRow& r : rows)
    page += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", r.scene, r.size, r.setting,
                        error(r.rms), amount(r.worst), amount(r.seconds), amount(r.copies));
  return page + default_of_frames(rows) +
         "![rms error against time](plots/frames_rms.svg)\n"
         "![worst error against time](plots/frames_worst.svg)\n\n";
}

// Returns the part on orbits.  Its last paragraph takes two times from formulas.  The rain falls by
// dr/dtau = -sqrt(2/r), so (sqrt 2/3) r^(3/2) is left at r.  With an angular momentum L the term
// 2 L^2/r^3 of the radial speed's square (reference_orbit.h) outweighs all others near the centre.
// Then dr/dtau = -sqrt(2) L r^(-3/2), and r^(5/2)/(2.5 sqrt(2) L) is left.
//
// A double between 64 and 128 is rounded by up to 7e-15.  Divided by the times left, 1.5e-5 and
// 2.3e-9, this moves r by 2/3 and 2/5 of the quotient, a relative 3e-10 and 1e-6.
std::string orbits(const Report& report, const std::vector<NamedPlot>& plots) {
  std::string page =
      "## Orbits\n\nStates along an orbit follow from its closed form, or from the quadratures "
      "that stand for one, and from\nintegrating the geodesic equation. Each is compared with "
      "formulas and quadratures with 50 digits. Times are\nfor a thousand states.\n\n"
      "| orbit | method | tolerance | r, relative | φ, radians | drift of E | of L | of u·u | s "
      "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const OrbitErrorRow& r : report.orbits)
    page += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {:.2g} |\n", r.orbit, r.method,
                        r.tolerance > 0 ? fmt::format("{:.0e}", r.tolerance) : "", error(r.r_error),
                        error(r.phi_error), error(r.energy_drift), error(r.angular_momentum_drift),
                        error(r.norm_drift), r.seconds);
  page +=
      "\n**The default is the closed form, or the quadratures.** They are the most exact, and make "
      "any frame without the\nones before it. Their error at the end of a fall is the rounding of "
      "its proper time, which is here one double\nfrom the beginning on, as an integration has "
      "it. By (√2/3) r^(3/2) a fall takes 77 M from r = 30 M on, and\n1.5e-5 M of them are left "
      "at 0.001 M. With an angular momentum L, by r^(5/2)/(2.5 √2 L), only 2.3e-9 M are left.\nA "
      "show counts the time that is left, and the tests of `FarEnds` hold its r to 1e-13 down to "
      "1e-6 M. An integrated\ncircle with an error of about 1 in r has left the circle.\n\n";
  for (const NamedPlot& plot : plots)
    if (plot.name.rfind("orbit_", 0) == 0)
      page += fmt::format("![error against time](plots/{}.svg)\n", plot.name);
  return page + "\n";
}

// Returns the part on the figures, or nothing if none is drawn.
std::string curves(const std::vector<NamedPlot>& figures) {
  if (figures.empty()) return "";
  std::string page =
      "## The curves of the paper\n\nThese are the figures of A. Riazuelo, *Seeing relativity I*, "
      "whose files are named by their LaTeX labels. They\nare drawn from the tables that frames "
      "are rendered with.\n\n";
  for (const NamedPlot& figure : figures)
    page += fmt::format("![{}](figures/{}.svg)\n", figure.plot.title, figure.name);
  return page + "\n";
}

}  // namespace

std::string accuracy_page(const Report& report, const std::vector<NamedPlot>& plots,
                          const std::vector<NamedPlot>& figures) {
  std::string page =
      head(report) + rays(report) + places(report) + frames(report.frames) + orbits(report, plots);
  if (!report.extremes.empty())
    page += fmt::format(
        "## Where something diverges\n\nThese are stiff and extreme cases, and the tests hold each "
        "to its bound. In the column *what happens* the\ncounts, the light and the errors were "
        "measured; sizes of skies and holes, and distances of images, follow from "
        "formulas.\n\n{}\n",
        report.extremes);
  return fmt::format("{}{}The plots were drawn by {}.\n", page, curves(figures), gnuplot_version());
}

}  // namespace domefall
