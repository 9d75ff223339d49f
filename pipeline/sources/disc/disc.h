// A Disc is an accretion disc.  It is thin, opaque or nearly so, and lies in a plane through the
// hole of region I.  Its matter moves on circular orbits and glows as a blackbody.  docs/disc.md
// says what is drawn of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <variant>
#include <vector>

#include "pipeline/sources/disc/gas_orbits.h"
#include "trajectories/directions.h"

namespace domefall {

// ---- patterns: what the light of each place is multiplied by; disc_pattern.h says how ----

// A TurbulencePattern has filaments that the orbits draw out.  They live for some orbits and are
// replaced.
struct TurbulencePattern {
  double contrast = 1;  // 0 to 1; 1 lets the gaps go dark
  double orbits = 1;    // the life of a filament, in orbits of its place
  std::uint32_t seed = 1;

  bool operator==(const TurbulencePattern&) const = default;
};
// A RingPattern has bright rings at equal distances, which drift inwards.
struct RingPattern {
  double spacing = 2;  // M
  double contrast = 0.8;
  double inward_speed = 0.02;  // M of radius per M of the hole's time

  bool operator==(const RingPattern&) const = default;
};
// A SpotPattern is a spot on a circular orbit.
struct SpotPattern {
  double r = 8;
  double azimuth = 0;     // radians from Disc::node at t = 0, in the sense of the orbit
  double size = 0.7;      // M, the standard deviation of its Gaussian
  double brightness = 5;  // of its middle over the gas beside it, >= 1

  bool operator==(const SpotPattern&) const = default;
};
// A MapPattern is a picture of the disc: azimuths from Disc::node, in the sense of the orbits, go to the
// right, and radii from `inner` to `outer` upwards.  It looks as painted at t = `at`.
struct MapPattern {
  std::filesystem::path file;
  double at = 0;  // M
  double inner = 6, outer = 20;

  bool operator==(const MapPattern&) const = default;
};
using PatternKind = std::variant<TurbulencePattern, RingPattern, SpotPattern, MapPattern>;

// ---- the disc ----

struct Disc {
  // Matter circles down to the last stable orbit and plunges below.
  GasOrbits orbits{};
  // There is matter between these radii (units of M).  The last stable orbit <= inner < outer
  // holds, or the horizon <= inner where the matter plunges.
  double inner = 6, outer = 20;
  // The disc turns counter-clockwise about this axis, a direction of the celestial sphere, on which
  // the observer stands at column 0 of ObserverState::sky_from_tetrad.
  SkyDirection normal{V3d(0, 0, 1)};
  // Azimuths in the disc's plane are counted from this direction, which is at right angles to the
  // normal.
  SkyDirection node{V3d(1, 0, 0)};
  double t_max_k = 1e4;  // of the hottest ring outside the last stable orbit, in its own frame
  // This is the luminance of that ring for whoever moves with it, in cd/m^2.  All other light of
  // the disc follows.
  double luminance = 1e-3;
  // This is the optical depth through the disc at right angles; infinite gas is opaque.  Where `rim`
  // is above 0, it thins out towards both ends, over this part of their radius, half the width at most.
  double optical_depth = std::numeric_limits<double>::infinity(), rim = 0;
  // H/r of its Gaussian section at the outer radius, from where it falls inwards as r^(1/8), as of
  // the outer part of Shakura and Sunyaev's disc; 0 of a sheet.
  double height = 0;
  double opacity = 1;  // all that it takes away and sends is this part of what it would be, 0 to 1
  // This says whether matter falls in from the last stable orbit, and shines on its way.
  bool plunging = false;
  // Gas has at most one pattern of turbulence, of rings and of a map, which multiply, and any number of
  // spots.
  std::vector<PatternKind> patterns{};
  // This says whether patterns are seen as they were when the light left them.  Otherwise all of it is
  // seen at once, as it is when light that falls straight in passes the observer (t = v).
  bool slow_light = true;

  double height_at(double r) const { return height * std::sqrt(std::sqrt(std::sqrt(r / outer))); }
  bool is_opaque() const { return std::isinf(optical_depth); }

  bool operator==(const Disc& other) const {
    return orbits == other.orbits && inner == other.inner && outer == other.outer &&
           normal.v == other.normal.v && node.v == other.node.v && patterns == other.patterns &&
           slow_light == other.slow_light && t_max_k == other.t_max_k &&
           luminance == other.luminance && opacity == other.opacity && plunging == other.plunging &&
           optical_depth == other.optical_depth && rim == other.rim && height == other.height;
  }
};

}  // namespace domefall
