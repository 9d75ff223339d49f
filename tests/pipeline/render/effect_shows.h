// Shows that leave some effects out, for the tests of effects, and tracers of their view rays.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/render/rays/view_tracer.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {

inline constexpr double kV = 0.5;  // in units of c, as in the paper's figures of single effects
inline const double kGamma = 1 / std::sqrt(1 - kV * kV);

inline HalfFrame render(const Show& show) { return Renderer(show, 1).render(frame_state(show, 0)); }

struct Traced {
  explicit Traced(const Show& show)
      : state(frame_state(show, 0)),
        tracer(state, WantedSkies{{true, true, true}, true}, show.effects) {}
  FrameState state;
  ViewTracer tracer;
};

inline const Effects kNoAberration{false, true, true, true, Amplification::kStars};
inline const Effects kOnlyAberration{true, false, false, true, Amplification::kStars};
inline const Effects kOnlyColour{false, true, false, true, Amplification::kStars};
inline const Effects kOnlyIntensity{false, false, true, true, Amplification::kStars};
inline const Effects kNoLensing{true, true, true, false, Amplification::kStars};
inline const Effects kNothing{false, false, false, false, Amplification::kNone};

// Observers outside and inside, in all four regions.
inline std::vector<Trajectory> observers() {
  return {StaticObserver{3},
          StaticObserver{2 + 1e-9},
          RadialInfall{2 + 1e-12},
          CircularOrbit{6},
          RadialInfall{2.001},
          RadialInfall{2},
          RadialInfall{1.2},
          RadialInfall{0.05},
          GivenVelocity{Region::kI, Tetrad::kRain, 30, {300, -800, 500}},
          GivenVelocity{Region::kI, Tetrad::kOutgoing, 5, {1, 2, 3}},
          GivenVelocity{Region::kII, Tetrad::kRain, 1.3, {0, 1e4, 0}},
          GivenVelocity{Region::kIII, Tetrad::kRainOfThree, 4, {2, 0, 1}},
          GivenVelocity{Region::kIV, Tetrad::kOutgoing, 0.2, {0, 1, 0}},
          GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}}};
}

// Combinations of effects.  Only outside the horizon can lensing be left out.
inline std::vector<Effects> combinations(bool outside) {
  std::vector<Effects> all{kNoAberration, kOnlyAberration, kOnlyColour, kOnlyIntensity};
  all.push_back({true, true, true, true, Amplification::kEverything});
  all.push_back({false, false, true, true, Amplification::kEverything});
  if (!outside) return all;
  all.push_back(kNoLensing);
  all.push_back(kNothing);
  all.push_back({true, false, true, false, Amplification::kEverything});
  return all;
}

inline bool is_outside(const Trajectory& t) { return point_at(t, 0).r > 2; }

inline Show at_rest_at(double r, const Effects& effects) {
  Show show = show_of(StaticObserver{r}, Stereographic{120, 90, 90 * kDegree});
  show.timeline[0].camera.attitude = EulerAngles{0.3, std::numbers::pi - 0.2, 0.1};
  show.sky[SkyRegion::kI] = {GridSky{}, 1, std::nullopt, 1};
  show.effects = effects;
  return show;
}

}  // namespace domefall
