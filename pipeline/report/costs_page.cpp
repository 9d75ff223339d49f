#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/report/report.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

constexpr const char* kCostsText =
#include "pipeline/report/costs_page.inc"
    ;

constexpr double kMilli = 1e3, kNano = 1e9;  // in a second
using Counted = double FrameCostRow::*;

std::string count(double value) { return fmt::format("{:.0f}", value); }

std::vector<std::string> scenes_of(const std::vector<FrameCostRow>& rows) {
  std::vector<std::string> scenes;
  for (const FrameCostRow& row : rows)
    if (scenes.empty() || scenes.back() != row.scene) scenes.push_back(row.scene);
  return scenes;
}

// Returns a table against stars or pixels, the slope over all rows of each scene, and the largest
// rise of the slope from row to row.  The last column is the cost of each further star or pixel
// since the row before.
std::string cost_part(const std::vector<FrameCostRow>& rows, Counted counted,
                      const std::string& unit) {
  const std::vector<CostSlope> found = slopes(rows, counted);
  const auto line = [&](const FrameCostRow& row) {
    // A slope stands in the row at its upper end, whose number it has copied.
    const auto slope = std::ranges::find_if(
        found, [&](const CostSlope& s) { return s.scene == row.scene && s.to == row.*counted; });
    return table_line(row.scene, row.size, count(row.stars), amount(kMilli * row.seconds),
                      amount(row.copies), amount(kNano * row.seconds / row.pixels),
                      slope == found.end() ? "" : amount(slope->ns));
  };
  std::string text = fmt::format(
      "| scene | dome | stars | ms | copies | ns per pixel | ns per further {} |\n"
      "|---|---|---|---|---|---|---|\n{}\n",
      unit, lines_of(rows, line));
  text += lines_of(scenes_of(rows), [&](const std::string& scene) {
    return fmt::format("* {}: {} ns for each further {}, from the first row to the last\n", scene,
                       amount(mean_slope(rows, counted, scene)), unit);
  });
  const auto rise = steepest_rise(found);
  if (!rise)
    return text +
           "\nThese frames are too small for a slope from row to row: one is below what can be "
           "timed.\n\n";
  return text +
         fmt::format(
             "\nA cliff would be a slope many times the one before it. **The largest ratio of a "
             "slope to the one before is {:.2f}** ({}, at {} {}s).\n\n",
             rise->ratio, rise->scene, count(rise->at), unit);
}

// ---- Against other ways ----

constexpr double kPixel4k = std::numbers::pi / 4096;  // radians

// Returns the quickest row of rk4, over ordinary rays of region I, in which 99 of 100 rays are
// right to a hundredth of a pixel of a 4k dome.  It is null if there is none.
const RayErrorRow* quickest_rk4(const std::vector<RayErrorRow>& rows) {
  // This is the bound that the renderer keeps where it interpolates view rays
  // (docs/architecture.md).
  constexpr double kPart = 0.01;
  const RayErrorRow* best = nullptr;
  for (const RayErrorRow& row : rows) {
    // The error on the sky counts, since that is what pixels show.
    const bool will_do = row.region == "I" && row.difficulty == "ordinary" && row.method == "rk4" &&
                         row.undecided == 0 && row.sky_99 <= kPart * kPixel4k;
    if (will_do && (best == nullptr || row.ns_per_ray < best->ns_per_ray)) best = &row;
  }
  return best;
}

// Compares the paper's first way, a geodesic for every pixel ([Riazuelo] sec. sec_cel1), with a
// finished pixel.  Of a geodesic only its own time counts, while the pixel has its light and its
// anti-aliasing besides, so the ratio says too little rather than too much.
std::string against_rk4(const Report& report) {
  const RayErrorRow* rk4 = quickest_rk4(report.rays);
  const FrameCostRow* sky = nullptr;  // the row of the largest dome without stars
  for (const FrameCostRow& row : report.costs.pixels)
    if (row.stars == 0) sky = &row;
  if (rk4 == nullptr || sky == nullptr) return "";
  const double pixel_ns = kNano * sky->seconds / sky->pixels;
  return fmt::format(
      "* **A geodesic for every pixel.** The paper's own integration (*rk4* of "
      "[accuracy.md](accuracy.md)), at the\n  tolerance by which it is quickest while 99 of 100 "
      "ordinary rays of region I are right to a hundredth of a pixel\n  of a 4k dome ({:.0e}), "
      "takes {} ns a ray. A pixel of the sky alone in a finished frame of {},\n  its light and "
      "anti-aliasing included, takes {} ns: {} times less.\n",
      rk4->setting, amount(rk4->ns_per_ray), sky->size, amount(pixel_ns),
      amount(rk4->ns_per_ray / pixel_ns));
}

// Compares a view ray of a frame, with all that its pixel needs, with the walk through a table.
std::string against_table_walk(const std::vector<ViewRaySpeedRow>& rows) {
  // A renderer of this kind, Bruneton's black_hole_shader (arXiv:2010.08735), has 512 by 512 places
  // in its table.  What a walk through such a table takes depends on the processor, so the page
  // calls the number a measure.
  constexpr double kWalkNs = 100;  // taken as the measure, not measured
  std::string text = fmt::format(
      "* **A table in two dimensions** that a pixel walks through in {} ns, taken as the measure. "
      "A view ray, from the\n  pixel's direction to place, redshift and footprint on the sky, "
      "takes",
      amount(kWalkNs));
  for (const ViewRaySpeedRow& row : rows)
    text += fmt::format("{} {:.1f} ns ({}: {} times less)", &row == rows.data() ? "" : ",", row.ns,
                        row.from, amount(kWalkNs / row.ns));
  return text + ".\n";
}

// Compares the default with 2 x 2 view rays everywhere, over all scenes that have both.  That is
// the paper's way to smooth a picture ([Riazuelo] sec. sec_data).  As ratios, error and time are
// averaged by their logarithms, and the page also counts the scenes, since a mean could hide one
// that is worse.
std::string against_supersampling(const std::vector<FrameErrorRow>& rows) {
  int scenes = 0, good = 0;
  double log_error = 0, log_time = 0;
  std::string worse;
  for (const FrameErrorRow& usual : rows)
    for (const FrameErrorRow& other : rows) {
      const bool pair = usual.scene == other.scene &&
                        usual.setting.find("default") != std::string::npos &&
                        other.setting == "2 x 2 everywhere";
      if (!pair) continue;
      const double ratio = usual.rms / other.rms;
      ++scenes, good += ratio <= 1 ? 1 : 0;
      log_error += std::log(ratio), log_time += std::log(usual.copies / other.copies);
      if (ratio > 1)
        worse += fmt::format("{}{}: {}", worse.empty() ? "" : "; ", usual.scene, amount(ratio));
    }
  if (scenes == 0) return "";
  return fmt::format(
      "* **Twice the resolution, then smoothed**, as the paper does: 2 x 2 view rays everywhere. "
      "Over the scenes of\n  [frames.csv](frames.csv) the default has {:.2f} times its rms error "
      "in "
      "{:.2f} times its time (geometric means), and no larger an error in {} of {} scenes{}.\n",
      std::exp(log_error / scenes), std::exp(log_time / scenes), good, scenes,
      worse.empty() ? "" : "; the others, as times its error: " + worse);
}

// The paper's minute is of a processor of its time, so the page quotes it and draws no ratio.
std::string benchmark_line(const FrameErrorRow& r) {
  return table_line(r.scene, fmt::format("{0} x {0}", r.size), r.setting, error_text(r.rms),
                    amount(r.worst), amount(kMilli * r.seconds), amount(r.copies));
}

}  // namespace

// The background of the frames against stars is black, so that the time of a sky does not hide
// theirs.
std::string costs_page(const Report& report) {
  const FrameCosts& costs = report.costs;
  return fmt::format(
      fmt::runtime(kCostsText), fmt::arg("quick", report.quick ? " --quick" : ""),
      fmt::arg("machine", machine_table()),
      fmt::arg("stars", cost_part(costs.stars, &FrameCostRow::stars, "star")),
      fmt::arg("pixels", cost_part(costs.pixels, &FrameCostRow::pixels, "pixel")),
      fmt::arg("other_ways", against_rk4(report) + against_table_walk(report.view_rays) +
                                 against_supersampling(report.frames)),
      fmt::arg("benchmark", lines_of(costs.benchmark, benchmark_line)));
}

}  // namespace domefall
