#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/silhouette.h"
#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/renderer.h"
#include "pipeline/report/extreme_cases.h"
#include "pipeline/show/assets.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr int kSize = 96;
constexpr double kMilliarcsecond = pi / 180 / 3600e3;

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// A held instant with every sky lit: the grid in all regions, stars in I and III.
Show show_of(const Trajectory& trajectory, const Projection& projection, const Attitude& attitude) {
  Show show;
  show.projection = projection;
  show.hole_at = {V3d(0, 0, 1)};  // the worst place: the pole of the grid is in line with the hole
  show.sky[SkyRegion::kI].background = GridSky{};
  show.sky[SkyRegion::kI].stars = StarField{shipped_asset(kNakedEyeStars), 5};
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

// Frames that were made; the renderer throws for a pixel that is not finite.
class Frames {
 public:
  void add(const Show& show) {
    ++frames_;
    try {
      const HalfFrame frame = Renderer(show, 0).render(frame_state(show, 0));
      for (const Imath::half value : frame.pixels) {
        if (!std::isfinite(static_cast<float>(value)) || value < 0) ++bad_;
        brightest_ = std::max(brightest_, static_cast<double>(value));
      }
    } catch (const std::runtime_error&) {
      ++bad_;
    }
  }
  ExtremeResult result(const std::string& more) const {
    return {static_cast<double>(bad_),
            text("%d frames, brightest pixel %.3g. ", frames_, brightest_) + more};
  }

 private:
  int frames_ = 0, bad_ = 0;
  double brightest_ = 0;
};

void add_domes(Frames& frames, const Trajectory& trajectory) {
  for (const double vartheta : {0.0, pi / 2, pi})  // away from the hole, across, towards it
    frames.add(show_of(trajectory, Domemaster{kSize}, EulerAngles{0, vartheta, 0}));
}

ExtremeResult lorentz_factor_of_a_million() {
  Frames frames;
  for (const GivenVelocity& place : {GivenVelocity{Region::kI, Tetrad::kRain, 10, {}},
                                     GivenVelocity{Region::kI, Tetrad::kRain, 2.001, {}},
                                     GivenVelocity{Region::kII, Tetrad::kRain, 0.5, {}},
                                     GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.5, {}}})
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          GivenVelocity moving = place;
          moving.celerity = V3d(x, y, z).normalized() * 1e6;
          frames.add(show_of(moving, Domemaster{kSize / 3}, LookAlongMotion{}));
        }
  return frames.result(
      "The sky gathers in a point ahead; of the grid's blackbodies the visible light fades there");
}

ExtremeResult static_frame() {
  Frames frames;
  for (const double altitude : {1e-12, 1e-6}) add_domes(frames, StaticObserver{2 + altitude});
  return frames.result("The sky is a bright point overhead");
}

ExtremeResult frames_at(std::initializer_list<double> radii, const char* outcome) {
  Frames frames;
  for (const double r : radii) add_domes(frames, RadialInfall{r});
  return frames.result(outcome);
}

ExtremeResult white_hole_frames() {
  Frames frames;
  for (const double r : {1e-6, 1.0, 2 - 1e-9, 2 - 1e-15, 2.0})
    add_domes(frames, GivenVelocity{Region::kIV, Tetrad::kOutgoing, r, {}});
  for (const double r : {1e-6, 1.0, 2 - 1e-9, 2 - 1e-12})
    add_domes(frames, GivenVelocity{Region::kIV, Tetrad::kOutgoing, r,
                                    resting_celerity(r, Tetrad::kOutgoing)});
  for (const double r : {2 - 1e-12, 2 - 1e-9})
    add_domes(frames, GivenVelocity{Region::kII, Tetrad::kRain, r, resting_celerity(r)});
  return frames.result("The glow of the past singularity fills the dome, without a seam at r = 2");
}

// Pictures of an odd size, whose middle pixel looks exactly along the axis, where the sines of angle
// and azimuth vanish together; and looks along the axis to the last bit.
ExtremeResult pixel_on_the_axis() {
  Frames frames;
  int unknown = 0;
  for (const double r : {1e-3, 1.0, 2.0, 2.5, 30.0, 1e8})
    for (const bool towards : {false, true}) {
      const Show show =
          show_of(RadialInfall{r}, Domemaster{kSize + 1}, EulerAngles{0, towards ? pi : 0, 0});
      frames.add(show);
      const FrameState state = frame_state(show, 0);
      const HoleOptics optics = make_hole_optics(r, Tetrad::kRain, {true, true, true});
      const V3d axis =
          apply_transposed(state.observer.tetrad_from_camera, V3d(towards ? -1 : 1, 0, 0));
      const ViewRay look = ViewTracer(state, optics).trace({axis});
      unknown += !std::isfinite(look.sky_direction.length()) || !std::isfinite(look.radial_scale);
    }
  ExtremeResult result = frames.result("On the axis a look shows the point behind the observer");
  result.worst += unknown;
  return result;
}

// Three skies that shrink to a point, or gather in one, ever brighter: region III after the crossing, a
// static observer's above the horizon, and what lies ahead at ever higher speed.  With an intensity that
// grows like the square of the frequency, light gained by blueshift is lost by size, so each frame of a
// series brings the same light; the change from any to the last is measured.
ExtremeResult crowded_skies() {
  constexpr int kSteps = 4;
  struct Series {
    const char* name;
    std::function<GivenVelocity(double)> at;
    Attitude attitude;
  };
  const std::vector<Series> all{
      {"region III",
       [](double depth) {
         return GivenVelocity{Region::kII, Tetrad::kRain, 2 - depth, {}};
       },
       LookAtHole{}},
      {"static",
       [](double altitude) {
         return GivenVelocity{Region::kI, Tetrad::kRain, 2 + altitude,
                              resting_celerity(2 + altitude)};
       },
       EulerAngles{}},
      {"ahead",
       [](double slowness) {
         return GivenVelocity{Region::kI, Tetrad::kRain, 10, V3d(0, 0.6, 0.8) / slowness};
       },
       LookAlongMotion{}}};
  double worst = 0;
  std::string outcome;
  for (const Series& series : all) {
    Show show = show_of(StaticObserver{10}, Domemaster{kSize + 1}, series.attitude);
    show.sky[SkyRegion::kI] = RegionSky{PanoramaSky{shipped_asset(kMilkyWay)}, 1, std::nullopt, 1};
    show.sky[SkyRegion::kIII] = show.sky[SkyRegion::kI];
    if (series.name == all[0].name) show.sky[SkyRegion::kI].background = BlackSky{};
    show.sky[SkyRegion::kIV].background = BlackSky{};
    show.frames_per_second = 1;
    show.timeline.resize(kSteps, show.timeline[0]);
    for (int k = 0; k < kSteps; ++k) {
      Segment& segment = show.timeline[static_cast<std::size_t>(k)];
      segment.trajectory = series.at(std::pow(10, -4 - 5.0 / 3 * k));
      segment.camera.elevation = pi / 2;
    }
    Renderer renderer(show, 0);
    std::array<double, kSteps> light{};
    for (int k = 0; k < kSteps; ++k)
      for (const Imath::half value : renderer.render(frame_state(show, k)).pixels)
        light[static_cast<std::size_t>(k)] += static_cast<double>(value);
    for (const double each : light)
      worst = std::max(worst, light.back() > 0 ? std::abs(each / light.back() - 1) : 1e9);
    outcome += (outcome.empty() ? "" : "; ") + std::string(series.name) +
               text(": light %.4g to %.4g", light.front(), light.back());
  }
  return {worst, "From 1e-4 to 1e-9 " + outcome};
}

// Looks along both poles of the sky, where right ascension has no value.
ExtremeResult pole_of_the_sky() {
  Frames frames;
  for (const double side : {-1.0, 1.0}) {
    frames.add(show_of(StaticObserver{}, Domemaster{kSize + 1}, LookAtSky{{V3d(0, 0, side)}}));
    frames.add(show_of(StaticObserver{30}, Domemaster{kSize + 1}, LookAtSky{{V3d(0, 0, side)}}));
    frames.add(show_of(StaticObserver{}, Stereographic{kSize + 1, kSize + 1, 1e-6},
                       LookAtSky{{V3d(0, 0, side)}}));
  }
  return frames.result("The poles' discs are round");
}

// [Riazuelo] fig. fig_z: eight pictures from 90 degrees to 160 milliarcseconds at the silhouette's
// edge seen from 30 M, in which the seventh ghost is visible.  Each look of the middle row against
// the exact integral at the offset that the projection gives it, in pixels.
ExtremeResult zoom_to_the_seventh_ghost() {
  constexpr double kRadius = 30;
  const int size = kSize + 1;
  const double last = 160 * kMilliarcsecond, zoom = std::pow(pi / 2 / last, 1.0 / 7);
  Frames frames;
  double worst = 0;
  for (int picture = 0; picture < 8; ++picture) {
    const double fov = pi / 2 / std::pow(zoom, picture);
    const double aside = picture == 0 ? 0 : fov / 4;  // so that the edge is in the picture
    const double edge = silhouette_edge(kRadius), vartheta = pi - edge - aside;
    const Show show =
        show_of(RadialInfall{kRadius}, Stereographic{size, size, fov}, EulerAngles{0, vartheta, 0});
    frames.add(show);
    const FrameState state = frame_state(show, 0);
    const HoleOptics optics = make_hole_optics(kRadius, Tetrad::kRain, {});
    const ViewTracer tracer(state, optics);
    for (int i = 1; i <= size; ++i) {
      const double middle = (size + 1) / 2.0;
      // X runs along increasing vartheta, towards the hole.
      const double turn = 2 * std::atan((i - middle) * 2 * std::tan(fov / 4) / size);
      const ViewRay look =
          tracer.trace(direction_at(show.projection, {static_cast<double>(i), middle}));
      if (look.sky != SkyRegion::kI || aside - turn <= 0) continue;
      const NullRay ray = ray_off_edge(kRadius, Critical::kFirst, aside - turn);
      const V3d seen = apply_transposed(state.observer.sky_from_tetrad, look.sky_direction);
      const double phi = exact_azimuth(ray);
      const double off =
          std::hypot(seen.x - std::cos(phi), std::hypot(seen.y, seen.z) - std::abs(std::sin(phi)));
      worst = std::max(worst, off / look.radial_scale / (fov / size));
    }
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
      {"FramesOfAStaticObserver", "static at r = 2 + 1e-12 and 2 + 1e-6", bad, 0, static_frame},
      {"FramesAcrossTheHorizon", "r = 2(1 ± 1e-15), 2, 2 - 1e-9", bad, 0,
       [] {
         return frames_at({2 + 2e-15, 2.0, 2 - 2e-15, 2 - 1e-9}, "Region III lights up as a point");
       }},
      {"FramesDeepInside", "r = 1e-3 and 1e-6", bad, 0,
       [] {
         return frames_at({1e-3, 1e-6}, "Two half skies and a bright band between them");
       }},
      {"FramesFarAway", "r = 1e8", bad, 0,
       [] { return frames_at({1e8}, "The hole is a ten-thousandth of a pixel"); }},
      {"FramesOfTheWhiteHole", "IV from r = 1e-6 to 2; T_IV and T_II next to r = 2", bad, 0,
       white_hole_frames},
      {"CrowdedSkies", "skies smaller than a pixel: r = 2 ∓ 1e-4 to 1e-9, gamma = 1e4 to 1e9",
       "change of the light in the frame", 0.05, crowded_skies},
      {"PixelOnTheAxis", "a pixel exactly on the axis of the hole", bad, 0, pixel_on_the_axis},
      {"PoleOfTheSky", "the poles of the sky in the middle of the picture, to 1 µrad across", bad,
       0, pole_of_the_sky},
      {"ZoomToTheSeventhGhost", "eight zooms to 160 mas across", "displacement, pixels", 0.01,
       zoom_to_the_seventh_ghost},
  };
}

std::string extreme_table() {
  std::string table =
      "| case | tried | what happens | worst | of | bound |\n|---|---|---|---|---|---|\n";
  for (const auto& list : {extreme_rays(), extreme_frames()})
    for (const ExtremeCase& c : list) {
      const ExtremeResult result = c.measure();
      table += "| " + c.name + " | " + c.tried + " | " + result.outcome + " | " +
               text("%.2g", result.worst) + " | " + c.quantity + " | " + text("%.2g", c.bound) +
               " |\n";
    }
  return table;
}

}  // namespace domefall
