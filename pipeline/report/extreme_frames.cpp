#include <cmath>
#include <numbers>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/report/extreme_cases.h"
#include "pipeline/report/extreme_show.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Adds three domes of an observer.  Each shows half of the view, so the first and the last show all
// of it together.
void add_domes(FrameTally& frames, const Trajectory& trajectory) {
  for (const double vartheta : {0.0, pi / 2, pi})  // away from the hole, across it, towards it
    frames.add(extreme_show(trajectory, Domemaster{kExtremeSize}, EulerAngles{0, vartheta, 0}));
}

// A celerity of 1e6 is gamma v, so gamma = sqrt(1 + 1e12) is 1e6 to 5e-13.
ExtremeResult lorentz_factor_of_a_million() {
  FrameTally frames;
  for (const GivenVelocity& place :
       {GivenVelocity{Region::kI, Tetrad::kRain, 10, V3d(0, 0, 0)},
        GivenVelocity{Region::kI, Tetrad::kRain, 2.001, V3d(0, 0, 0)},
        GivenVelocity{Region::kII, Tetrad::kRain, 0.5, V3d(0, 0, 0)},
        GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.5, V3d(0, 0, 0)}})
    // The 26 directions lead from the middle of a cube to its faces, edges and corners.
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          GivenVelocity moving = place;
          moving.celerity = V3d(x, y, z).normalized() * 1e6;
          frames.add(extreme_show(moving, Domemaster{kExtremeSize / 3}, LookAlongMotion{}));
        }
  return frames.result(
      "The sky gathers in a point ahead; of the grid's blackbodies the visible light fades there");
}

// The sky has a radius of 1.84 sqrt(r - 2) radians (extreme_frame_errors.cpp), 1.8e-6 and 1.8e-3
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
    add_domes(frames, GivenVelocity{Region::kIV, Tetrad::kOutgoing, r, V3d(0, 0, 0)});
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
      const HoleOptics optics = make_hole_optics(r, Tetrad::kRain, {true, true, true});
      const V3d axis =
          apply_transposed(state.observer.tetrad_from_camera, V3d(towards ? -1 : 1, 0, 0));
      const ViewRay ray = ViewTracer(state, optics).trace({axis});
      // An azimuth that is not found would leave the direction not finite, and a slope that is 0/0
      // the scale.
      unknown += !std::isfinite(ray.sky_direction.length()) || !std::isfinite(ray.radial_scale);
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

}  // namespace

std::vector<ExtremeCase> extreme_frames() {
  const std::string bad = "pixels that are not finite";
  return {
      {"LorentzFactorOfAMillion", "gamma = 1e6 in 26 directions, at four places in I, II and IV",
       bad, 0, lorentz_factor_of_a_million},
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
  };
}

}  // namespace domefall
