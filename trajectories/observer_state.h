// ObserverState is all that crosses from trajectories to light.  It says where the observer is, how
// it moves against a tetrad that is regular at the horizon, and how its camera is turned
// ([Riazuelo] sec. sec_cam).  It never has a four-velocity in (t, r), which is singular at r = 2M.
#pragma once

#include <utility>

#include "pipeline/spacetime/spacetime.h"
#include "trajectories/celerity.h"
#include "trajectories/directions.h"

namespace domefall {

struct ObserverState {
  Spacetime spacetime;
  Region region = Region::kI;
  // has_tetrad(region, tetrad); in a wormhole it is kRain on both sides, with R towards region I
  Tetrad tetrad = Tetrad::kRain;
  int universe = 0;       // of those that follow each other through a charged hole
  double r = kFlatSpace;  // units of M, > 0; kFlatSpace without a black hole
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
  // In a wormhole r is r(l), and this is the proper length from the middle of its throat, positive in
  // region I and negative in region III.  Elsewhere it is 0.
  double l = 0;
  // In a wormhole this is the direction in which its mouth was seen at the start of the show, a unit
  // vector on the sky of region I (sky_axes).
  V3d mouth_at_start{1, 0, 0};
  // The columns are the directions of R, Theta and Phi of the reference tetrad on the celestial
  // sphere, so R is the observer's place as seen from the hole.  It is a rotation.  What lies on a
  // sky is placed by sky_axes().
  M33d sky_from_tetrad;
  Celerity<ReferenceTetrad> celerity;  // any finite value is possible
  // The columns are camera X, Y, Z in the boosted tetrad (B R, B Theta, B Phi), with B the boost of
  // [Riazuelo] eq. Lambda_cov.  It is a rotation.
  M33d tetrad_from_camera;
};

inline bool is_flat(const ObserverState& o) { return o.spacetime.is_flat(); }

// Returns the directions of R, Theta and Phi on one sky, as columns.  They are those of
// sky_from_tetrad, but on the sky of region III of a wormhole their mirror images: who looks outward
// there looks at the spheres about the throat from their other side, and is to see that sky the
// right way round.  The mirror stands across the view of the mouth at the show's start.  So the far
// sky is seen upright in the mouth, and who flies straight in has the same places ahead, above and
// to the right as on this side.
M33d sky_axes(const ObserverState& o, SkyRegion sky);

// Returns the sky of the region that the tetrad belongs to, in a wormhole that of the observer's
// side.
inline SkyRegion own_sky(const ObserverState& o) {
  if (!o.spacetime.is<Wormhole>()) return own_sky(o.tetrad, o.universe);
  return o.region == Region::kIII ? SkyRegion::kIII : SkyRegion::kI;
}

inline PerSky<bool> seen_skies(const ObserverState& o) {
  return o.spacetime.seen_skies(o.region, o.tetrad, o.universe, o.r);
}

// Says whether there is an observer at rest in r at the same place.
inline bool has_rest(const ObserverState& o) { return o.spacetime.lapse_squared(o.r) > 0; }

// Returns the celerity of what is at rest in r (outside) or in t (inside a horizon).
Celerity<ReferenceTetrad> resting_celerity(const Spacetime& spacetime, double r, Tetrad tetrad);
// The same at the observer's place.  About a hole that spins it is at rest in r who has no angular
// momentum, and so turns with it.
Celerity<ReferenceTetrad> resting_celerity(const ObserverState& o);

// Returns d/dt along T and along R, Theta and Phi, at the observer's place.
std::pair<double, V3d> static_time(const ObserverState& o);

inline V3d axis_of(const SpinningHole& hole) { return {hole.axis[0], hole.axis[1], hole.axis[2]}; }
// Returns the angle from the axis of a hole that spins.
double polar_angle(const ObserverState& o, const SpinningHole& hole);

// Returns dr/dtau of a motion, for any tetrad.
double radial_rate(const Spacetime& spacetime, double r, Tetrad tetrad,
                   const Celerity<ReferenceTetrad>& celerity);

// Returns the celerity against the observer at rest, where there is one (has_rest).  R points to
// growing r.
Celerity<RestFrame> static_celerity(const ObserverState& o);

// Returns the celerity against rain, for any tetrad where r > spacetime.horizon().
Celerity<RainTetrad> rain_celerity(const Spacetime& spacetime, double r, Tetrad tetrad,
                                   const Celerity<ReferenceTetrad>& celerity);

}  // namespace domefall
