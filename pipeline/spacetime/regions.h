// The regions of the maximally extended spacetime, the tetrads that are regular on their horizons,
// and the skies that light comes from: those of the two asymptotically flat regions, and the past
// singularity of region IV, which counts as a sky wherever a show lights it.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace domefall {

// Inside the inner horizon of a charged hole lie V, which is entered from I, and VI, its mirror image.
enum class Region { kI, kII, kIII, kIV, kV, kVI };

inline const char* region_name(Region region) {
  constexpr const char* kNames[] = {"I", "II", "III", "IV", "V", "VI"};
  return kNames[static_cast<int>(region)];
}

// Returns the name of a region in one of the universes that follow each other through a charged hole:
// those of region I are I, I+1, I+2 and so on.
inline std::string region_name(Region region, int universe) {
  std::string name = region_name(region);
  if (universe > 0) name += '+';
  if (universe != 0) name += std::to_string(universe);
  return name;
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

// StaticTime holds the components of d/dt along T and R of rain, of which the latter has the opposite
// sign in the outgoing tetrad.  A celerity with gamma and w along R has the energy E = along_t gamma
// - along_r w and dr/dtau = along_t w - along_r gamma.
struct StaticTime {
  double along_t = 1, along_r = 0;
};

constexpr bool is_outgoing(Tetrad t) {
  return t == Tetrad::kOutgoing || t == Tetrad::kOutgoingToThree;
}
// Says whether a tetrad is of region III.  What is said of sky I in the other two holds of sky III,
// and the reverse.
constexpr bool is_mirrored(Tetrad t) {
  return t == Tetrad::kRainOfThree || t == Tetrad::kOutgoingToThree;
}
constexpr bool is_outside(Region region) { return region == Region::kI || region == Region::kIII; }
constexpr bool is_within_inner_horizon(Region region) {
  return region == Region::kV || region == Region::kVI;
}
// Says whether two regions lie on different sides of a horizon, so that a place on it may count as
// either's.
constexpr bool are_apart(Region a, Region b) {
  return is_outside(a) != is_outside(b) || is_within_inner_horizon(a) != is_within_inner_horizon(b);
}
// Says whether a region has a tetrad.  Rain is found outside and beyond the future horizon, the
// outgoing frame outside and before the past one, and both inside an inner horizon.
constexpr bool has_tetrad(Region region, Tetrad t) {
  if (region == Region::kI || region == Region::kV) return !is_mirrored(t);
  if (region == Region::kIII || region == Region::kVI) return is_mirrored(t);
  return is_outgoing(t) == (region == Region::kIV);
}

// These return what the reflection t -> -t leads to.
constexpr Region mirror_of(Region region) {
  switch (region) {
    case Region::kI:
      return Region::kIII;
    case Region::kIII:
      return Region::kI;
    case Region::kV:
      return Region::kVI;
    case Region::kVI:
      return Region::kV;
    default:
      return region;
  }
}
constexpr Tetrad mirror_of(Tetrad t) {
  if (is_outgoing(t)) return is_mirrored(t) ? Tetrad::kOutgoing : Tetrad::kOutgoingToThree;
  return is_mirrored(t) ? Tetrad::kRain : Tetrad::kRainOfThree;
}

// A SkyRegion is the region in which light started that reaches the observer.  Through a charged hole
// universes follow each other, of which every other one has the sky kNext in its region I.
enum class SkyRegion : char { kI, kIII, kIV, kNext };
inline constexpr std::array kEverySky{SkyRegion::kI, SkyRegion::kIII, SkyRegion::kIV,
                                      SkyRegion::kNext};
// These are the skies of the exteriors.  Only they have stars.
inline constexpr std::array kExteriorSkies{SkyRegion::kI, SkyRegion::kIII, SkyRegion::kNext};

inline const char* name_of(SkyRegion sky) {
  constexpr std::array kNames{"I", "III", "IV", "next"};
  return kNames[static_cast<std::size_t>(sky)];
}

// Returns the sky of the region, I or III of a universe, that a tetrad belongs to.
constexpr SkyRegion own_sky(Tetrad t, int universe) {
  if (is_mirrored(t)) return SkyRegion::kIII;
  return universe % 2 == 0 ? SkyRegion::kI : SkyRegion::kNext;
}

// A PerSky has one value for each sky.
template <class T>
struct PerSky {
  std::array<T, kEverySky.size()> values{};  // in the order of kEverySky

  constexpr T& operator[](SkyRegion sky) { return values[static_cast<std::size_t>(sky)]; }
  constexpr const T& operator[](SkyRegion sky) const {
    return values[static_cast<std::size_t>(sky)];
  }
  constexpr auto begin() const { return values.begin(); }
  constexpr auto end() const { return values.end(); }
};

}  // namespace domefall
