// ObserverState is all that crosses from trajectories to light: where the observer is, how it moves
// against a tetrad that is regular at the horizon, and how its camera is turned.  Never a
// four-velocity in (t, r), which is singular at r = 2M.  [Riazuelo] sec. sec_cam.
#pragma once

#include <limits>

#include "trajectories/directions.h"

namespace domefall {

enum class Region { kI, kII, kIII, kIV };

inline const char* region_name(Region region) {
  constexpr const char* kNames[] = {"I", "II", "III", "IV"};
  return kNames[static_cast<int>(region)];
}

// The radius of an observer in flat space: every formula has its limit there.
inline constexpr double kFlatSpace = std::numeric_limits<double>::infinity();

struct ObserverState {
  Region region = Region::kI;
  double r = kFlatSpace;  // units of M, > 0; kFlatSpace without a black hole
  double proper_time =
      0;  // units of M (seconds in flat space), since the start of the segment's orbit
  // Columns: the directions of R, Theta and Phi of the reference tetrad on the celestial sphere, so
  // R is the observer's place as seen from the hole.  A rotation.
  M33d sky_from_tetrad;
  // gamma * velocity against the reference tetrad (T_I, the rain frame, in regions I and II;
  // [Riazuelo] eq. tetrad_start), components along (R, Theta, Phi).  Any finite value.
  V3d celerity{0, 0, 0};
  // Columns: camera X, Y, Z in the boosted tetrad (B R, B Theta, B Phi), with B the boost of
  // [Riazuelo] eq. Lambda_cov.  A rotation.
  M33d tetrad_from_camera;
};

inline bool is_flat(const ObserverState& o) { return o.r == kFlatSpace; }

}  // namespace domefall
