#include <algorithm>

#include "pipeline/report/report.h"
#include "pipeline/report/text.h"

namespace domefall {
namespace {

// An error below this value is drawn at it, since a logarithmic axis has no 0.
constexpr double kFloor = 1e-18;
double drawn(double error) { return std::max(error, kFloor); }

constexpr double kMicro = 1e-3;  // microseconds in a nanosecond

// Adds the point to the curve of that name.  The first point of a name creates its curve.
void add_point(Plot& plot, const std::string& name, const PlotPoint& point) {
  auto curve = std::find_if(plot.curves.begin(), plot.curves.end(),
                            [&](const PlotCurve& c) { return c.name == name; });
  if (curve == plot.curves.end()) {
    const int colour = static_cast<int>(plot.curves.size());
    curve = plot.curves.insert(curve, {name, {}, colour, PlotCurve::Style::kPoints});
  }
  curve->points.push_back(point);
}

// Returns an empty plot of an error against a time.  Both span many powers of ten, so both axes are
// logarithmic.  An integration of order n is a straight line of slope -n there, as long as its
// error is not of rounding.
Plot log_plot(const std::string& title, const std::string& x, const std::string& y) {
  return {.title = title,
          .x = {x, Axis::Scale::kLog},
          .y = {y, Axis::Scale::kLog},
          .legend = "outside right"};
}

// A member of the row says which error is drawn.
using RayValue = double RayErrorRow::*;

Plot ray_plot(const std::vector<RayErrorRow>& rows, const RayClass& of, const char* what,
              RayValue error) {
  Plot plot = log_plot(std::string("Rays seen from ") + place_of(of) + ", " + of.name,
                       "time for one ray, µs", what);
  for (const RayErrorRow& row : rows)
    if (row.region == of.region && row.difficulty == of.name)
      add_point(plot, row.method, {row.ns_per_ray * kMicro, drawn(row.*error)});
  return plot;
}

// Supersampling every pixel is another method than supersampling the difficult ones, so it has a
// dashed curve of its own in the scene's colour, which begins with one view ray for each pixel.
// Interpolating nothing is a third method, but it has one setting and so is a single point.  The
// scenes have the same colours in all three plots because each plot meets them in the same order.
Plot frame_plot(const std::vector<FrameErrorRow>& rows, const char* what,
                double FrameErrorRow::*error) {
  Plot plot = log_plot("Frames by the renderer's anti-aliasing (dashed: in every pixel)",
                       "CPU time, in copies of the frame", what);
  plot.legend = "below";
  Plot everywhere, exact;
  for (const FrameErrorRow& row : rows) {
    const auto says = [&](const char* part) { return row.setting.find(part) != std::string::npos; };
    Plot& its = says("everywhere") || row.setting == "1 view ray" ? everywhere
                : says("none interpolated")                       ? exact
                                                                  : plot;
    add_point(its, row.scene, {row.copies, row.*error});
  }
  for (PlotCurve& curve : everywhere.curves) curve.style = PlotCurve::Style::kDashed;
  for (const Plot* other : {&everywhere, &exact})
    for (PlotCurve curve : other->curves) {
      curve.name.clear();
      plot.curves.push_back(curve);
    }
  return plot;
}

// Orbits that are not integrated have a single method and so no plot.
void add_orbit_plots(const std::vector<OrbitErrorRow>& rows, std::vector<NamedPlot>& plots) {
  // A row gives the seconds of a thousand states.  Its errors are of r, relative, and of the
  // azimuth, in radians.  Both are displacements over r, to first order, so the larger one stands
  // for the place.
  constexpr double kStates = 1000, kMicroseconds = 1e6;
  std::vector<std::string> orbits;
  for (const OrbitErrorRow& row : rows)
    if (row.tolerance > 0 && std::find(orbits.begin(), orbits.end(), row.orbit) == orbits.end())
      orbits.push_back(row.orbit);
  for (const std::string& orbit : orbits) {
    Plot plot = log_plot("Orbit: " + orbit, "time for one state, µs",
                         "error of the place (relative in r, or radians)");
    for (const OrbitErrorRow& row : rows)
      if (row.orbit == orbit)
        add_point(
            plot, row.method,
            {row.seconds / kStates * kMicroseconds, drawn(std::max(row.r_error, row.phi_error))});
    plots.push_back({"orbit_" + slug(orbit), plot});
  }
}

// Returns a plot of milliseconds against stars or pixels, with one curve for each scene.  A cost in
// proportion to the number is a straight line of slope 1 on these axes.
Plot cost_plot(const std::vector<FrameCostRow>& rows, const char* title, const char* x,
               double FrameCostRow::*counted) {
  constexpr double kMilli = 1e3;
  Plot plot = log_plot(title, x, "CPU time of one thread, ms");
  plot.legend = "top left";
  for (const FrameCostRow& row : rows)
    add_point(plot, row.scene, {row.*counted, kMilli * row.seconds});
  return plot;
}

}  // namespace

std::vector<NamedPlot> cost_plots(const FrameCosts& costs) {
  return {{"costs_stars", cost_plot(costs.stars, "A frame by the stars of its catalogue",
                                    "stars of the catalogue", &FrameCostRow::stars)},
          {"costs_pixels", cost_plot(costs.pixels, "A frame by its size", "pixels of the dome",
                                     &FrameCostRow::pixels)}};
}

std::vector<NamedPlot> error_plots(const Report& report) {
  std::vector<NamedPlot> plots;
  for (const RayClass& of : ray_classes()) {
    const std::string name = std::string("rays_") + of.region + "_" + of.name;
    const char* what = of.kind == RayKind::kSpin
                           ? "error of the place, radians, 99 of 100 rays below"
                           : "error of φ, 99 of 100 rays below";
    plots.push_back({name, ray_plot(report.rays, of, what, &RayErrorRow::phi_99)});
    plots.push_back(
        {name + "_sky", ray_plot(report.rays, of, "error on the sky, radians, 99 of 100 rays below",
                                 &RayErrorRow::sky_99)});
  }
  plots.push_back({"frames_rms", frame_plot(report.frames, "root mean square error, white = 1",
                                            &FrameErrorRow::rms)});
  plots.push_back({"frames_worst", frame_plot(report.frames, "worst error of a pixel, white = 1",
                                              &FrameErrorRow::worst)});
  add_orbit_plots(report.orbits, plots);
  return plots;
}

}  // namespace domefall
