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

// The frames that velocities and directions are given against: radial free fall, either inward from
// rest at infinity ("rain", T_I of [Riazuelo] eq. tetrad_start, regular in I and II) or outward to
// rest at infinity (T_I', sec. on region IV, regular in IV and I); or the mirror images of the two
// under t -> -t, which fall from region III and to it.  R points to the infinity that the frame
// belongs to.  Each is singular on the horizon that it does not cross, so a state near r = 2M names
// the one that does.
enum class Tetrad { kRain, kOutgoing, kRainOfThree, kOutgoingToThree };

inline const char* tetrad_name(Tetrad t) {
  constexpr const char* kNames[] = {"rain", "outgoing", "rain_of_III", "outgoing_to_III"};
  return kNames[static_cast<int>(t)];
}

constexpr bool is_outgoing(Tetrad t) {
  return t == Tetrad::kOutgoing || t == Tetrad::kOutgoingToThree;
}
// Of region III: what is said of sky I in the other two holds of sky III, and the reverse.
constexpr bool is_mirrored(Tetrad t) {
  return t == Tetrad::kRainOfThree || t == Tetrad::kOutgoingToThree;
}
// Rain is found outside and beyond the future horizon, the outgoing frame outside and before the
// past one.
constexpr bool has_tetrad(Region region, Tetrad t) {
  if (region == Region::kI || region == Region::kIII)
    return is_mirrored(t) == (region == Region::kIII);
  return is_outgoing(t) == (region == Region::kIV);
}

// The reflection t -> -t.
constexpr Region mirror_of(Region region) {
  if (region == Region::kI) return Region::kIII;
  return region == Region::kIII ? Region::kI : region;
}
constexpr Tetrad mirror_of(Tetrad t) {
  if (is_outgoing(t)) return is_mirrored(t) ? Tetrad::kOutgoing : Tetrad::kOutgoingToThree;
  return is_mirrored(t) ? Tetrad::kRain : Tetrad::kRainOfThree;
}

// The radius of an observer in flat space: every formula has its limit there.
inline constexpr double kFlatSpace = std::numeric_limits<double>::infinity();

struct ObserverState {
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;  // has_tetrad(region, tetrad)
  double r = kFlatSpace;          // units of M, > 0; kFlatSpace without a black hole
  double proper_time =
      0;  // units of M (seconds in flat space), since the start of the segment's orbit
  // v = t + r* (rain) or u = t - r* (outgoing frame) of the observer, r* = r + 2 ln|r/2 - 1|, units
  // of M, since the start of the show: what the emission times of the singularity's light count
  // from.  Where a trajectory changes its tetrad it goes from the one to the other of the same t.
  // Of the mirrored frames after t -> -t.  Stands still for a held instant.
  double null_time = 0;
  // Radians swept in the planes of its orbits since the start of the show.
  double azimuth = 0;
  // Columns: the directions of R, Theta and Phi of the reference tetrad on the celestial sphere, so
  // R is the observer's place as seen from the hole.  A rotation.
  M33d sky_from_tetrad;
  // gamma * velocity against the reference tetrad, components along (R, Theta, Phi).  Any finite
  // value.
  V3d celerity{0, 0, 0};
  // Columns: camera X, Y, Z in the boosted tetrad (B R, B Theta, B Phi), with B the boost of
  // [Riazuelo] eq. Lambda_cov.  A rotation.
  M33d tetrad_from_camera;
};

inline bool is_flat(const ObserverState& o) { return o.r == kFlatSpace; }

}  // namespace domefall
