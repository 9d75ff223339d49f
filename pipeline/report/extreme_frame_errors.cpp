#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/silhouette.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/renderer.h"
#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/extreme_show.h"
#include "pipeline/show/assets.h"

namespace domefall {
namespace {

using std::numbers::pi;

// ---- light ----

constexpr int kSteps = 4;  // frames of a series, whose step falls from 1e-4 to 1e-9

struct Series {
  const char* name;
  GivenVelocity (*at)(double step);
  Attitude attitude;
  bool sky_one;  // whether region I's sky is lit
};

// Returns the rain at r = 2 - d, where region III has just appeared.  The edge of its sky,
// tan(delta/2) = (-r - (r - 3) sqrt(1 + 6/r))/(3 sqrt 3 (1 + sqrt(2/r))), is delta = (3 sqrt 3/8) d
// to first order, and within it 1 + z = sqrt(2/r) - 1 = d/4.  So the solid angle shrinks like
// (1 + z)^2.
GivenVelocity below_the_horizon(double depth) {
  return {Region::kII, Tetrad::kRain, 2 - depth, V3d(0, 0, 0)};
}

// Returns an observer at rest at r = 2 + h, who sees the sky of region I in a disc about R whose
// radius has the sine sqrt(27 (1 - 2/r))/r.  That is 1.84 sqrt(h) to first order, and all of its
// light has 1 + z = sqrt(1 - 2/r) = sqrt(h/2).
GivenVelocity at_rest_above_the_horizon(double altitude) {
  return {Region::kI, Tetrad::kRain, 2 + altitude, resting_celerity(2 + altitude)};
}

// Returns an observer of celerity 1/slowness, which is the Lorentz factor too, to 1 part in
// 2 gamma^2.  The sky ahead is blueshifted by up to 2 gamma and gathers within angles of about
// 1/gamma.
GivenVelocity moving_fast(double slowness) {
  return {Region::kI, Tetrad::kRain, 10, V3d(0, 0.6, 0.8) / slowness};
}

// Returns a show of the Milky Way whose intensity grows like the square of the frequency, by the
// default of PanoramaShift.  Without stars or a grid all light in the frames comes from that sky.
Show show_of_series(const Series& series) {
  Show show = extreme_show(StaticObserver{10}, Domemaster{kExtremeSize + 1}, series.attitude);
  show.sky[SkyRegion::kI] = RegionSky{PanoramaSky{shipped_asset(kMilkyWay)}, 1, std::nullopt, 1};
  show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
  // Where region III is measured, the sky of region I stays black, so that the sum of the pixels
  // has only the light of the small sky.
  if (!series.sky_one) show.sky[SkyRegion::kI].background = BlackSky{};
  show.sky[SkyRegion::kIV].background = BlackSky{};
  show.frames_per_second = 1;
  show.timeline.resize(kSteps, show.timeline[0]);
  for (int k = 0; k < kSteps; ++k) {
    Segment& segment = show.timeline[static_cast<std::size_t>(k)];
    segment.trajectory = series.at(std::pow(10, -4 - 5.0 / 3 * k));
    // The target stands in the zenith, and a frame of an odd size has a pixel there.
    segment.camera.elevation = pi / 2;
  }
  return show;
}

// Returns the sum of all pixel values of each frame.
std::array<double, kSteps> light_of_frames(const Show& show) {
  Renderer renderer(show, 0);
  std::array<double, kSteps> light{};
  for (int k = 0; k < kSteps; ++k)
    for (const Imath::half value : renderer.render(frame_state(show, k)).pixels)
      light[static_cast<std::size_t>(k)] += static_cast<double>(value);
  return light;
}

// Three skies shrink to a point, or gather in one, and become ever brighter: region III after the
// crossing, a static observer's sky above the horizon, and the sky ahead at ever higher speed.  A
// blueshift by a factor D shrinks the solid angle by D^2.  The intensity grows like the square of
// the frequency and so by D^2, so each frame of a series receives the same light.  The case
// measures the change from any frame to the last.
ExtremeResult crowded_skies() {
  const std::array<Series, 3> all{{{"region III", below_the_horizon, LookAtHole{}, false},
                                   {"static", at_rest_above_the_horizon, EulerAngles{}, true},
                                   {"ahead", moving_fast, LookAlongMotion{}, true}}};
  double worst = 0;
  std::string outcome;
  for (const Series& series : all) {
    const std::array<double, kSteps> light = light_of_frames(show_of_series(series));
    for (const double each : light)
      // A last frame without light is a failure, whatever the bound.
      worst = std::max(worst, light.back() > 0 ? std::abs(each / light.back() - 1) : 1e9);
    outcome += fmt::format("{}{}: light {:.4g} to {:.4g}", outcome.empty() ? "" : "; ", series.name,
                           light.front(), light.back());
  }
  return {worst, "From 1e-4 to 1e-9 " + outcome};
}

// ---- place ----

constexpr double kExtremeRadius = 30;
constexpr double kMilliarcsecond = pi / 180 / 3600e3;

// Returns the worst displacement of the view rays through the middle row, in pixels of the angle
// fov/size.  A pixel in the middle of the frame is wider than that by the factor 4 tan(fov/4)/fov,
// which is 1.05 in the widest view and 1.001 or less in the others.
//
// The edge of the silhouette lies at the angle `aside` from the middle.  Each view ray is compared
// with the exact integral, at the offset from that edge that the projection gives to the ray.
double worst_displacement(const Show& show, int size, double fov, double aside) {
  const FrameState state = frame_state(show, 0);
  const HoleOptics optics = make_hole_optics(kExtremeRadius, Tetrad::kRain, {});
  const ViewTracer tracer(state, optics);
  const double middle = (size + 1) / 2.0;
  double worst = 0;
  for (int i = 1; i <= size; ++i) {
    // X runs along increasing vartheta, towards the hole.  The stereographic projection puts an
    // angle from the middle at a distance proportional to the tangent of its half, and fov/2 at the
    // border.
    const double turn = 2 * std::atan((i - middle) * 2 * std::tan(fov / 4) / size);
    const ViewRay ray =
        tracer.trace(direction_at(show.projection, {static_cast<double>(i), middle}));
    // Rays beyond the edge come from the past singularity and are not compared.
    if (ray.sky != SkyRegion::kI || aside - turn <= 0) continue;
    const double phi = exact_azimuth(ray_off_edge(kExtremeRadius, Critical::kFirst, aside - turn));
    const V3d seen = apply_transposed(state.observer.sky_from_tetrad, ray.sky_direction);
    // The ray's plane contains R, so its direction has the component cos(phi) along R and
    // |sin(phi)| across.  The displacement on the sky over d phi/d delta is the angle in the
    // picture.
    const double off =
        std::hypot(seen.x - std::cos(phi), std::hypot(seen.y, seen.z) - std::abs(std::sin(phi)));
    worst = std::max(worst, off / ray.radial_scale / (fov / size));
  }
  return worst;
}

// These are the eight views of [Riazuelo] fig. fig_z, from 90 degrees to 160 milliarcseconds wide,
// at the silhouette's edge seen from 30 M.  The seventh ghost is visible in the last of them.
ExtremeResult zoom_to_the_seventh_ghost() {
  const int size = kExtremeSize + 1;
  // The caption of the figure gives a zoom of around 4 from view to view.  To lead from 90 degrees
  // to 160 mas, each of seven zooms must be by (90 degrees/160 mas)^(1/7) = 7.96.
  const double last = 160 * kMilliarcsecond, zoom = std::pow(pi / 2 / last, 1.0 / 7);
  FrameTally frames;
  double worst = 0;
  for (int view = 0; view < 8; ++view) {
    const double fov = pi / 2 / std::pow(zoom, view);
    const double aside = view == 0 ? 0 : fov / 4;  // so that the edge is in the frame
    const double vartheta = pi - silhouette_edge(kExtremeRadius) - aside;
    const Show show = extreme_show(RadialInfall{kExtremeRadius}, Stereographic{size, size, fov},
                                   EulerAngles{0, vartheta, 0});
    frames.add(show);
    worst = std::max(worst, worst_displacement(show, size, fov, aside));
  }
  ExtremeResult result = frames.result("Ghost by ghost appears, each 23 times nearer to the edge");
  result.worst = std::max(result.worst, worst);
  return result;
}

}  // namespace

std::vector<ExtremeCase> extreme_frame_errors() {
  return {
      {"CrowdedSkies", "skies smaller than a pixel: r = 2 ∓ 1e-4 to 1e-9, gamma = 1e4 to 1e9",
       "change of the light in the frame", 0.05, crowded_skies},
      {"ZoomToTheSeventhGhost", "eight zooms to 160 mas across", "displacement, pixels", 0.01,
       zoom_to_the_seventh_ghost},
  };
}

}  // namespace domefall
