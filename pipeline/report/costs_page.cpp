#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/report/machine.h"
#include "pipeline/report/report.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

constexpr double kMilli = 1e3, kNano = 1e9;  // in a second
using Counted = double FrameCostRow::*;

std::string count(double value) { return fmt::format("{:.0f}", value); }

// Returns the names of the scenes, whose rows stand together, in the order of the rows.
std::vector<std::string> scenes_of(const std::vector<FrameCostRow>& rows) {
  std::vector<std::string> scenes;
  for (const FrameCostRow& row : rows)
    if (scenes.empty() || scenes.back() != row.scene) scenes.push_back(row.scene);
  return scenes;
}

// The last column is the cost of each further star or pixel since the row before.
std::string cost_table(const std::vector<FrameCostRow>& rows, Counted counted, const char* unit) {
  std::string table = fmt::format(
      "| scene | dome | stars | ms | copies | ns per pixel | ns per further {} |\n"
      "|---|---|---|---|---|---|---|\n",
      unit);
  const std::vector<CostSlope> found = slopes(rows, counted);
  for (const FrameCostRow& row : rows) {
    // A slope stands in the row at its upper end, whose number it has copied.
    const auto slope = std::find_if(found.begin(), found.end(), [&](const CostSlope& s) {
      return s.scene == row.scene && s.to == row.*counted;
    });
    table += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", row.scene, row.size,
                         count(row.stars), amount(kMilli * row.seconds), amount(row.copies),
                         amount(kNano * row.seconds / row.pixels),
                         slope == found.end() ? "" : amount(slope->ns));
  }
  return table + "\n";
}

// States the slope over all rows of each scene, and the largest rise of the slope from row to row.
std::string slopes_in_words(const std::vector<FrameCostRow>& rows, Counted counted,
                            const std::string& unit) {
  std::string text;
  for (const std::string& scene : scenes_of(rows))
    text += fmt::format("* {}: {} ns for each further {}, from the first row to the last\n", scene,
                        amount(mean_slope(rows, counted, scene)), unit);
  const auto rise = steepest_rise(slopes(rows, counted));
  if (!rise)
    return text +
           "\nThese frames are too small for a slope from row to row: one is below what can be "
           "timed.\n\n";
  return fmt::format(
      "{}\nA cliff would be a slope many times the one before it. **The largest ratio of a slope "
      "to "
      "the one before is {:.2f}** ({}, at {} {}s).\n\n",
      text, rise->ratio, rise->scene, count(rise->at), unit);
}

// Returns the part on stars.  Their background is black, so that the time of a sky does not hide
// theirs.
std::string stars(const std::vector<FrameCostRow>& rows) {
  return "## By the number of stars\n\nThe brightest stars of a made-up sky with as many of each "
         "magnitude as Tycho-2 has, in front of nothing.\nFalling at 7 M, every image that matters "
         "of every star is found and drawn.\n\n" +
         cost_table(rows, &FrameCostRow::stars, "star") +
         slopes_in_words(rows, &FrameCostRow::stars, "star") +
         "![time against stars](plots/costs_stars.svg)\n\n";
}

std::string pixels(const std::vector<FrameCostRow>& rows) {
  return "## By the number of pixels\n\nFalling at 7 M, looking at the hole. Pixels are those "
         "inside "
         "the dome. A larger dome is sharper, and\nits sky map's finer levels are read.\n\n" +
         cost_table(rows, &FrameCostRow::pixels, "pixel") +
         slopes_in_words(rows, &FrameCostRow::pixels, "pixel") +
         "![time against pixels](plots/costs_pixels.svg)\n\n";
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

// Returns the table of the paper's own task.  The paper's minute is of a processor of its time, so
// the page quotes it and draws no ratio.
std::string benchmark(const std::vector<FrameErrorRow>& rows) {
  std::string text =
      "\n### The paper's picture\n\n\"Typical images of one million pixel initially computed at a "
      "twice larger resolution and then smoothed needed\nin the first versions of our code needed "
      "one minute of single CPU time\" ([Riazuelo] sec. sec_data), with the\n250,000 stars of the "
      "Henry Draper catalogue. Here, on one thread, files read before; the errors are of the sky "
      "without\nits stars against 256 view rays in every pixel:\n\n| scene | pixels | setting | "
      "rms | "
      "worst | ms | copies |\n|---|---|---|---|---|---|---|\n";
  for (const FrameErrorRow& r : rows)
    text += fmt::format("| {0} | {1} x {1} | {2} | {3:.1e} | {4} | {5} | {6} |\n", r.scene, r.size,
                        r.setting, r.rms, amount(r.worst), amount(kMilli * r.seconds),
                        amount(r.copies));
  return text + "\n";
}

}  // namespace

std::string costs_page(const Report& report) {
  const FrameCosts& costs = report.costs;
  return fmt::format(
             "# What a frame costs\n\n`domefall report{}` made this page, like "
             "[accuracy.md](accuracy.md). That run measured every number below but\nthose that say "
             "what was rendered and those that are quoted: the time taken as the measure of a "
             "table "
             "in two\ndimensions, and what the paper says of its pictures.\n\n{}"
             "Whole frames with the default settings, on one thread, in CPU time and in copies of "
             "the "
             "frame's own memory, the\nquickest of several renderings into the same memory; files "
             "are "
             "read "
             "before. A small frame's copy stays in the processor's cache, and is quicker by the "
             "pixel. "
             "All rows:\n[costs.csv](costs.csv), [benchmark.csv](benchmark.csv). What its files "
             "cost: "
             "docs/file_costs.md.\n\n",
             report.quick ? " --quick" : "", machine_table()) +
         stars(costs.stars) + pixels(costs.pixels) + "## Against other ways\n\n" +
         against_rk4(report) + against_table_walk(report.view_rays) +
         against_supersampling(report.frames) + benchmark(costs.benchmark);
}

}  // namespace domefall
