// This file samples the path of a show's observer finely enough for a smooth curve.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/show/show.h"
#include "pipeline/spacetime/penrose.h"

namespace domefall {

// Returns the charge whose diagram has the same horizons, which for a spin is that of its axis.
std::optional<ChargedHole> two_horizons(const Spacetime& spacetime);

struct PathPoint {
  double time_s = 0;  // since the beginning of the show
  int segment = 0;
  Region region = Region::kI;
  int universe = 0;       // of those that follow each other through a charged hole
  double r = kFlatSpace;  // M, or radii of a wormhole's throat
  // Radians in the orbital plane from the show's start, in (-pi, pi]; about a hole that spins, in its
  // equator.  The sine is that of the angle from its axis, and the cosine: in a plane 1 and 0.
  double azimuth = 0;
  double sine = 1, cosine = 0;
  double swept = 0;      // radians since the start of the trajectory, unbounded
  double speed = 0;      // against the reference tetrad, or in flat space against the sky
  PenrosePoint penrose;  // unset in flat space
  bool is_in_drawn_turn = true;
};

// Where a segment has more than twice this many turns about the hole, only this many at its
// beginning and as many at its end are sampled finely.
inline constexpr double kTurnsDrawn = 20;

// These say whether the curve from one point of a path to the next is drawn.  It is, unless the
// path jumps between them.  In the orbital plane it is drawn only where the step is also small.
bool is_joined(const PathPoint& a, const PathPoint& b);
bool is_joined_in_plane(const PathPoint& a, const PathPoint& b);

// Says whether the path jumps from a to the next point b.  It does where b belongs to another
// segment and has another r, by more than 1e-6 of it, or is in another region that does not begin
// there.
bool is_jump(const PathPoint& a, const PathPoint& b);

// An Origin says where t = 0 lies in the Penrose diagram, and why it lies there.
struct Origin {
  double time_shift = 0;  // is added to t, in units of M
  enum class Centre { kMiddle, kCrossing, kTwoCrossings };
  Centre centre = Centre::kMiddle;
};

struct Path {
  // The points are in order of segments, and within a segment in order of time with both ends.
  // Where a segment dissolves into the next, the next one starts before its end.
  std::vector<PathPoint> points;
  std::vector<PathPoint> instants;  // one every `instant_step_s` seconds from the start
  double instant_step_s = 0;
  std::vector<Origin> origins;     // one for each segment; empty in flat space
  bool has_gaps_in_plane = false;  // a segment has more than 2 kTurnsDrawn turns
};

// Samples the path at about 2000 instants, at least 48 to a segment.  More are added wherever the
// curve turns by more than 2.5 degrees about the hole, r changes by more than 4 %, or the curve in
// the Penrose diagram moves by more than 1/150 of its height.  There are at most some 1e5 points.
// The instants are nearly even, but out of step with any period of the orbit.  Otherwise the points
// could all lie at one phase where there are too many turns to draw.
//
// The Killing symmetry t -> t + constant moves every point of the Penrose diagram along its curve
// of constant r.  The constant is chosen for each run of segments without a jump.  It puts the
// run's last crossing of the horizon at the middle of the horizon's line.  Where the past and the
// future horizon, or those before and after the inside of a charged hole, are crossed within 16 M,
// both crossings lie symmetrically.  Where no horizon is crossed, the middle of the run is at t = 0.
Path sample_path(const Show& show);

// Returns the smallest of 1, 2 and 5 times a power of ten that is `least` or more, for least > 0.
double round_step(double least);

}  // namespace domefall
