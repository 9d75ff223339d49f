#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/report/machine.h"
#include "pipeline/report/report.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

constexpr double kMilli = 1e3, kNano = 1e9;
using Counted = double FrameCostRow::*;

std::string count(double value) { return formatted("%.0f", value); }

std::vector<std::string> scenes_of(const std::vector<FrameCostRow>& rows) {
  std::vector<std::string> scenes;
  for (const FrameCostRow& row : rows)
    if (scenes.empty() || scenes.back() != row.scene) scenes.push_back(row.scene);
  return scenes;
}

// Each row with what each further star or pixel has cost since the row before it.
std::string cost_table(const std::vector<FrameCostRow>& rows, Counted counted, const char* unit) {
  std::string table = "| scene | dome | stars | ms | copies | ns per pixel | ns per further ";
  table += std::string(unit) + " |\n|---|---|---|---|---|---|---|\n";
  const std::vector<CostSlope> found = slopes(rows, counted);
  for (const FrameCostRow& row : rows) {
    const auto slope = std::find_if(found.begin(), found.end(), [&](const CostSlope& s) {
      return s.scene == row.scene && s.to == row.*counted;
    });
    table += "| " + row.scene + " | " + std::to_string(row.size) + " | " + count(row.stars) +
             " | " + amount(kMilli * row.seconds) + " | " + amount(row.copies) + " | " +
             amount(kNano * row.seconds / row.pixels) + " | " +
             (slope == found.end() ? "" : amount(slope->ns)) + " |\n";
  }
  return table + "\n";
}

std::string slopes_in_words(const std::vector<FrameCostRow>& rows, Counted counted,
                            const std::string& unit) {
  std::string text;
  for (const std::string& scene : scenes_of(rows)) {
    text += "* " + scene + ": ";
    text += amount(mean_slope(rows, counted, scene));
    text += " ns for each further " + unit + ", from the first row to the last\n";
  }
  const auto rise = steepest_rise(slopes(rows, counted));
  if (!rise)
    return text +
           "\nThese frames are too small for a slope from row to row: one is below what can be "
           "timed.\n\n";
  return text +
         "\nA cliff would be a slope many times the one before it. **The largest ratio of a "
         "slope to the one before is " +
         formatted("%.2f", rise->ratio) + "** (" + rise->scene + ", at " + count(rise->at) + " " +
         unit + "s).\n\n";
}

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

constexpr double kPixel4k = std::numbers::pi / 4096;

// The quickest of rk4's settings by which 99 of 100 rays are right to a hundredth of a pixel.
const RayErrorRow* quickest_rk4(const std::vector<RayErrorRow>& rows) {
  constexpr double kPart = 0.01;
  const RayErrorRow* best = nullptr;
  for (const RayErrorRow& row : rows) {
    const bool will_do = row.region == "I" && row.difficulty == "ordinary" && row.method == "rk4" &&
                         row.undecided == 0 && row.sky_99 <= kPart * kPixel4k;
    if (will_do && (best == nullptr || row.ns_per_ray < best->ns_per_ray)) best = &row;
  }
  return best;
}

std::string against_rk4(const Report& report) {
  const RayErrorRow* rk4 = quickest_rk4(report.rays);
  const FrameCostRow* sky = nullptr;  // of the largest dome
  for (const FrameCostRow& row : report.costs.pixels)
    if (row.stars == 0) sky = &row;
  if (rk4 == nullptr || sky == nullptr) return "";
  const double pixel_ns = kNano * sky->seconds / sky->pixels;
  return "* **A geodesic for every pixel.** The paper's own integration (*rk4* of "
         "[accuracy.md](accuracy.md)), at the\n  tolerance by which it is quickest while 99 of 100 "
         "ordinary rays of region I are right to a hundredth of a pixel\n  of a 4k dome (" +
         formatted("%.0e", rk4->setting) + "), takes " + amount(rk4->ns_per_ray) +
         " ns a ray. A pixel of the sky alone in a finished frame of " + std::to_string(sky->size) +
         ",\n  its light and anti-aliasing included, takes " + amount(pixel_ns) +
         " ns: " + amount(rk4->ns_per_ray / pixel_ns) + " times less.\n";
}

std::string against_table_walk(const std::vector<ViewRaySpeedRow>& rows) {
  constexpr double kWalkNs = 100;
  std::string text = "* **A table in two dimensions** that a pixel walks through in " +
                     amount(kWalkNs) +
                     " ns, taken as the mark. A look, from the pixel's\n  direction "
                     "to place, redshift and footprint on the sky, takes";
  for (const ViewRaySpeedRow& row : rows)
    text += (&row == rows.data() ? " " : ", ") + formatted("%.1f", row.ns) + " ns (" + row.from +
            ": " + amount(kWalkNs / row.ns) + " times less)";
  return text + ".\n";
}

// The errors of the default over those of 2 x 2 everywhere, of all scenes that have both.
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
      if (ratio > 1) worse += (worse.empty() ? "" : "; ") + usual.scene + ": " + amount(ratio);
    }
  if (scenes == 0) return "";
  return "* **Twice the resolution, then smoothed**, as the paper does: 2 x 2 looks everywhere. "
         "Over "
         "the scenes of\n  [frames.csv](frames.csv) the default has " +
         formatted("%.2f", std::exp(log_error / scenes)) + " times its rms error in " +
         formatted("%.2f", std::exp(log_time / scenes)) +
         " times its time (geometric means), and no larger an error in " + std::to_string(good) +
         " of " + std::to_string(scenes) + " scenes" +
         (worse.empty() ? "" : "; the others, as times its error: " + worse) + ".\n";
}

std::string benchmark(const std::vector<FrameErrorRow>& rows) {
  std::string text =
      "\n### The paper's picture\n\n\"Typical images of one million pixel initially computed at a "
      "twice larger resolution and then smoothed needed\nin the first versions of our code needed "
      "one minute of single CPU time\" ([Riazuelo] sec. sec_data), with the\n250,000 stars of the "
      "Henry Draper catalogue. Here, on one thread, files read before; the errors are of the sky "
      "without\nits stars against 256 looks in every pixel:\n\n| scene | pixels | setting | rms | "
      "worst | ms | copies |\n|---|---|---|---|---|---|---|\n";
  for (const FrameErrorRow& r : rows)
    text += "| " + r.scene + " | " + std::to_string(r.size) + " x " + std::to_string(r.size) +
            " | " + r.setting + " | " + formatted("%.1e", r.rms) + " | " + amount(r.worst) + " | " +
            amount(kMilli * r.seconds) + " | " + amount(r.copies) + " |\n";
  return text + "\n";
}

}  // namespace

std::string costs_page(const Report& report) {
  const FrameCosts& costs = report.costs;
  std::string page = "# What a frame costs\n\nMade by `domefall report";
  page += report.quick ? " --quick" : "";
  page += "`, like [accuracy.md](accuracy.md); every number below was measured by that run.\n\n" +
          machine_table();
  page +=
      "Whole frames with the default settings, on one thread, in CPU time and in copies of the "
      "frame's own memory, the\nquickest of several renderings into the same memory; files are "
      "read "
      "before. A small frame's copy stays in the processor's cache, and is quicker by the pixel. "
      "All rows:\n[costs.csv](costs.csv), [benchmark.csv](benchmark.csv).\n\n";
  return page + stars(costs.stars) + pixels(costs.pixels) + "## Against other ways\n\n" +
         against_rk4(report) + against_table_walk(report.view_rays) +
         against_supersampling(report.frames) + benchmark(costs.benchmark);
}

}  // namespace domefall
