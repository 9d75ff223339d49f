// ObserverState is all that crosses from trajectories to light.  It says where the observer is, how
// it moves against a tetrad that is regular at the horizon, and how its camera is turned
// ([Riazuelo] sec. sec_cam).  It never has a four-velocity in (t, r), which is singular at r = 2M.
#pragma once

#include <limits>

#include "trajectories/directions.h"

namespace domefall {

enum class Region { kI, kII, kIII, kIV };

inline const char* region_name(Region region) {
  constexpr const char* kNames[] = {"I", "II", "III", "IV"};
  return kNames[static_cast<int>(region)];
}

// A Tetrad is a frame that velocities and directions are given against.  It is radial free fall,
// either inward from rest at infinity ("rain", T_I of [Riazuelo] eq. tetrad_start, regular in I and
// II) or outward to rest at infinity (T_I', sec. on region IV, regular in IV and I).  The other two
// are the mirror images of these under t -> -t, which fall from region III and to it.  R points to
// the infinity that the frame belongs to.  Each is singular on the horizon that it does not cross,
// so a state near r = 2M names the one that does.
enum class Tetrad { kRain, kOutgoing, kRainOfThree, kOutgoingToThree };

inline const char* tetrad_name(Tetrad t) {
  constexpr const char* kNames[] = {"rain", "outgoing", "rain_of_III", "outgoing_to_III"};
  return kNames[static_cast<int>(t)];
}

constexpr bool is_outgoing(Tetrad t) {
  return t == Tetrad::kOutgoing || t == Tetrad::kOutgoingToThree;
}
// Says whether a tetrad is of region III.  What is said of sky I in the other two holds of sky III,
// and the reverse.
constexpr bool is_mirrored(Tetrad t) {
  return t == Tetrad::kRainOfThree || t == Tetrad::kOutgoingToThree;
}
// Says whether a region has a tetrad.  Rain is found outside and beyond the future horizon, the
// outgoing frame outside and before the past one.
constexpr bool has_tetrad(Region region, Tetrad t) {
  if (region == Region::kI || region == Region::kIII)
    return is_mirrored(t) == (region == Region::kIII);
  return is_outgoing(t) == (region == Region::kIV);
}

// These return what the reflection t -> -t leads to.
constexpr Region mirror_of(Region region) {
  if (region == Region::kI) return Region::kIII;
  return region == Region::kIII ? Region::kI : region;
}
constexpr Tetrad mirror_of(Tetrad t) {
  if (is_outgoing(t)) return is_mirrored(t) ? Tetrad::kOutgoing : Tetrad::kOutgoingToThree;
  return is_mirrored(t) ? Tetrad::kRain : Tetrad::kRainOfThree;
}

// This is the radius of an observer in flat space.  Every formula has its limit there.
inline constexpr double kFlatSpace = std::numeric_limits<double>::infinity();

struct ObserverState {
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;  // has_tetrad(region, tetrad)
  double r = kFlatSpace;          // units of M, > 0; kFlatSpace without a black hole
  double proper_time =
      0;  // units of M (seconds in flat space), since the start of the segment's orbit
  // This is v = t + r* (rain) or u = t - r* (outgoing frame) of the observer, with r* = r + 2
  // ln|r/2 - 1|, in units of M, since the start of the show.  The emission times of the
  // singularity's light count from it.  Where a trajectory changes its tetrad it goes from the one
  // to the other of the same t.  In the mirrored frames it is taken after t -> -t.  It stands still
  // for a held instant.
  double null_time = 0;
  // This is the angle swept in the planes of its orbits since the start of the show, in radians.
  double azimuth = 0;
  // The columns are the directions of R, Theta and Phi of the reference tetrad on the celestial
  // sphere, so R is the observer's place as seen from the hole.  It is a rotation.
  M33d sky_from_tetrad;
  // This is gamma * velocity against the reference tetrad, with components along (R, Theta, Phi).
  // Any finite value is possible.
  V3d celerity{0, 0, 0};
  // The columns are camera X, Y, Z in the boosted tetrad (B R, B Theta, B Phi), with B the boost of
  // [Riazuelo] eq. Lambda_cov.  It is a rotation.
  M33d tetrad_from_camera;
};

inline bool is_flat(const ObserverState& o) { return o.r == kFlatSpace; }

}  // namespace domefall
