#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/silhouette.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/renderer.h"
#include "pipeline/report/extreme_cases.h"
#include "pipeline/show/assets.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kExtremeSize = 96;  // pixels along an edge of a frame

// Returns a show in which every sky is lit: all regions have the grid, and I and III have stars.
// The hole stands at the pole of the grid, which is the worst place because right ascension has no
// value there.  Throws InputError if the shipped catalogue cannot be read.
Show extreme_show(const Trajectory& trajectory, const Projection& projection,
                  const Attitude& attitude) {
  Show show;
  if (reach(trajectory).first != kFlatSpace) show.spacetime = Schwarzschild{};
  show.projection = projection;
  show.hole_at = {V3d(0, 0, 1)};
  show.sky[SkyRegion::kI].background = GridSky{};
  show.sky[SkyRegion::kI].stars = StarField{shipped_asset(kStandardStars), 5};
  show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
  show.sky[SkyRegion::kIV].background = GridSky{};
  show.point_spread.min_sigma = 0.002;
  show.point_spread.max_sigma = 0.02;
  Segment segment;
  segment.duration_s = 1;
  segment.trajectory = trajectory;
  segment.camera.attitude = attitude;
  show.timeline = {segment};
  return show;
}

// A FrameTally renders frames and counts the pixel values that are not finite or are negative.
class FrameTally {
 public:
  // Renders frame 0 of the show.  If the renderer throws, as it does for a pixel that is not
  // finite, the frame counts as one bad value.
  void add(const Show& show) {
    Renderer renderer(show, 0);
    add(renderer, frame_state(show, 0));
  }
  void add(Renderer& renderer, const FrameState& state) {
    ++frames_;
    try {
      const HalfFrame frame = renderer.render(state);
      // The renderer refuses light that is not finite, which is counted below, and stores any other
      // light beyond the largest half, 65504, as that.  So a value here is bad only if the renderer
      // breaks one of these promises.
      for (const Imath::half value : frame.pixels) {
        if (!std::isfinite(static_cast<float>(value)) || value < 0) ++bad_;
        brightest_ = std::max(brightest_, static_cast<double>(value));
      }
    } catch (const std::runtime_error&) {
      ++bad_;
    }
  }

  // Returns the number of bad values as `worst`.  The text of the outcome gives the number of
  // frames, their brightest value, and then `more`.
  ExtremeResult result(const std::string& more) const {
    return {static_cast<double>(bad_),
            fmt::format("{} frames, brightest pixel {:.3g}. {}", frames_, brightest_, more)};
  }

 private:
  int frames_ = 0, bad_ = 0;
  double brightest_ = 0;
};

// Adds three domes of an observer.  Each shows half of the view, so the first and the last show all
// of it together.
void add_domes(FrameTally& frames, const Trajectory& trajectory) {
  for (const double vartheta : {0.0, pi / 2, pi})  // away from the hole, across it, towards it
    frames.add(extreme_show(trajectory, Domemaster{kExtremeSize}, EulerAngles{0, vartheta, 0}));
}

// A celerity of 1e6 is gamma v, so gamma = sqrt(1 + 1e12) is 1e6 to 5e-13.
ExtremeResult lorentz_factor_of_a_million() {
  FrameTally frames;
  for (const GivenVelocity& place : {GivenVelocity{Region::kI, Tetrad::kRain, 10, {0, 0, 0}},
                                     GivenVelocity{Region::kI, Tetrad::kRain, 2.001, {0, 0, 0}},
                                     GivenVelocity{Region::kII, Tetrad::kRain, 0.5, {0, 0, 0}},
                                     GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.5, {0, 0, 0}}})
    // The 26 directions lead from the middle of a cube to its faces, edges and corners.
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          GivenVelocity moving = place;
          moving.celerity = Celerity<ReferenceTetrad>(V3d(x, y, z).normalized() * 1e6);
          frames.add(extreme_show(moving, Domemaster{kExtremeSize / 3}, LookAlongMotion{}));
        }
  return frames.result(
      "The sky gathers in a point ahead; of the grid's blackbodies the visible light fades there");
}

// One renderer keeps the charts of each place.
ExtremeResult lorentz_factor_about_a_spin() {
  FrameTally frames;
  const KerrHole hole{0.9L};
  for (const double r : {10.0, 1.5}) {
    Show show = extreme_show(KerrCircling{hole, r, 1.2, dragged_velocity(hole, r, 1.2)},
                             Domemaster{kExtremeSize / 3}, EulerAngles{});
    show.spacetime = SpinningHole{1, hole};
    Renderer renderer(show, 0);
    for (const V3d& way : {V3d(1, 0, 0), V3d(-1, 0, 0), V3d(0, 0.6, 0.8), V3d(0.5, -0.5, -0.7)}) {
      FrameState state = frame_state(show, 0);
      state.observer.celerity = Celerity<ReferenceTetrad>(way.normalized() * 1e6);
      frames.add(renderer, state);
    }
  }
  return frames.result("As without a spin");
}

// The sky has a radius of 1.84 sqrt(r - 2) radians (at_rest_above_the_horizon()), 1.8e-6 and 1.8e-3
// here, against pi/96 = 0.033 of a pixel.
ExtremeResult static_frame() {
  FrameTally frames;
  for (const double altitude : {1e-12, 1e-6}) add_domes(frames, StaticObserver{2 + altitude});
  return frames.result("The sky is a bright point overhead");
}

ExtremeResult frames_at(std::initializer_list<double> radii, const char* outcome) {
  FrameTally frames;
  for (const double r : radii) add_domes(frames, RadialInfall{r});
  return frames.result(outcome);
}

ExtremeResult white_hole_frames() {
  FrameTally frames;
  // The first observers move freely outwards.  The others rest in t, by T_IV and T_II
  // ([Riazuelo] eq. TR_IV).  At r = 2 itself nothing rests in t, because its celerity
  // sqrt(r/(2 - r)) is infinite there.
  for (const double r : {1e-6, 1.0, 2 - 1e-9, 2 - 1e-15, 2.0})
    add_domes(frames, GivenVelocity{Region::kIV, Tetrad::kOutgoing, r, {}});
  for (const double r : {1e-6, 1.0, 2 - 1e-9, 2 - 1e-12})
    add_domes(frames, GivenVelocity{Region::kIV, Tetrad::kOutgoing, r,
                                    resting_celerity(r, Tetrad::kOutgoing)});
  for (const double r : {2 - 1e-12, 2 - 1e-9})
    add_domes(frames, GivenVelocity{Region::kII, Tetrad::kRain, r, resting_celerity(r)});
  return frames.result("The glow of the past singularity fills the dome, without a seam at r = 2");
}

// A frame of an odd size has a pixel whose view ray runs exactly along the axis, where the sines of
// angle and azimuth vanish together.  A view ray along the axis to the last bit is traced as well.
ExtremeResult pixel_on_the_axis() {
  FrameTally frames;
  int unknown = 0;
  for (const double r : {1e-3, 1.0, 2.0, 2.5, 30.0, 1e8})
    for (const bool towards : {false, true}) {
      const Show show = extreme_show(RadialInfall{r}, Domemaster{kExtremeSize + 1},
                                     EulerAngles{0, towards ? pi : 0, 0});
      frames.add(show);
      const FrameState state = frame_state(show, 0);
      const V3d axis =
          apply_transposed(state.observer.tetrad_from_camera, V3d(towards ? -1 : 1, 0, 0));
      const ViewRay ray = ViewTracer(state, WantedSkies{{true, true, true}}).trace({axis});
      // An azimuth that is not found would leave the direction not finite, and a slope that is 0/0
      // the scale.
      unknown += !std::isfinite(ray.sky_direction.length()) || !std::isfinite(ray.scale_along);
    }
  ExtremeResult result =
      frames.result("On the axis a view ray shows the point behind the observer");
  result.worst += unknown;
  return result;
}

// The middle pixels see the poles of the sky, where right ascension has no value.
ExtremeResult pole_of_the_sky() {
  FrameTally frames;
  for (const double side : {-1.0, 1.0}) {
    frames.add(
        extreme_show(StaticObserver{}, Domemaster{kExtremeSize + 1}, LookAtSky{{V3d(0, 0, side)}}));
    frames.add(extreme_show(StaticObserver{30}, Domemaster{kExtremeSize + 1},
                            LookAtSky{{V3d(0, 0, side)}}));
    frames.add(extreme_show(StaticObserver{},
                            Stereographic{kExtremeSize + 1, kExtremeSize + 1, 1e-6},
                            LookAtSky{{V3d(0, 0, side)}}));
  }
  return frames.result("The poles' discs are round");
}

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
  return {Region::kII, Tetrad::kRain, 2 - depth, {0, 0, 0}};
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
  return {Region::kI, Tetrad::kRain, 10, {0, 0.6 / slowness, 0.8 / slowness}};
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
  const ViewTracer tracer(state, WantedSkies{});
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
    worst = std::max(worst, off / ray.scale_along / (fov / size));
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

std::vector<ExtremeCase> extreme_frames() {
  const std::string bad = "pixels that are not finite";
  return {
      {"LorentzFactorOfAMillion", "gamma = 1e6 in 26 directions, at four places in I, II and IV",
       bad, 0, lorentz_factor_of_a_million},
      {"LorentzFactorAboutASpin", "gamma = 1e6 in 4 directions, a = 0.9, r = 10 and 1.5", bad, 0,
       lorentz_factor_about_a_spin},
      {"FramesOfAStaticObserver", "static at r = 2 + 1e-12 and 2 + 1e-6", bad, 0, static_frame},
      {"FramesAcrossTheHorizon", "r = 2(1 ± 1e-15), 2, 2 - 1e-9", bad, 0,
       [] {
         // Between 2 and 4 doubles are 4.4e-16 apart, and below 2 half of that, so these are radii
         // of their own.
         return frames_at({2 + 2e-15, 2.0, 2 - 2e-15, 2 - 1e-9}, "Region III lights up as a point");
       }},
      {"FramesDeepInside", "r = 1e-3 and 1e-6", bad, 0,
       [] {
         // Towards r = 0 the edges of both skies tend to pi/2, so that each sky fills a half of the
         // view.
         return frames_at({1e-3, 1e-6}, "Two half skies and a bright band between them");
       }},
      {"FramesFarAway", "r = 1e8", bad, 0,
       // The silhouette is 2 (3 sqrt 3)/r = 1.0e-7 radians wide, and a pixel pi/96.
       [] { return frames_at({1e8}, "The hole is 3e-6 of a pixel wide"); }},
      {"FramesOfTheWhiteHole", "IV from r = 1e-6 to 2; T_IV and T_II next to r = 2", bad, 0,
       white_hole_frames},
      {"PixelOnTheAxis", "a pixel exactly on the axis of the hole", bad, 0, pixel_on_the_axis},
      {"PoleOfTheSky", "the poles of the sky in the middle of the frame, to 1 µrad across", bad, 0,
       pole_of_the_sky},
      {"CrowdedSkies", "skies smaller than a pixel: r = 2 ∓ 1e-4 to 1e-9, gamma = 1e4 to 1e9",
       "change of the light in the frame", 0.05, crowded_skies},
      {"ZoomToTheSeventhGhost", "eight zooms to 160 mas across", "displacement, pixels", 0.01,
       zoom_to_the_seventh_ghost},
  };
}

}  // namespace domefall
