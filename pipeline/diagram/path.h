// The path of a show's observer, sampled finely enough to be drawn as a smooth curve.
#pragma once

#include <vector>

#include "pipeline/diagram/penrose.h"
#include "pipeline/show/show.h"

namespace domefall {

struct PathPoint {
  double time_s = 0;  // since the beginning of the show
  int segment = 0;
  Region region = Region::kI;
  double r = kFlatSpace;  // M
  double azimuth = 0;     // radians in the orbital plane from the show's start, in (-pi, pi]
  double swept = 0;       // radians since the start of the trajectory, unbounded
  double speed = 0;       // against the reference tetrad, or in flat space against the sky
  PenrosePoint penrose;   // unset in flat space
  bool is_in_drawn_turn = true;
};

// Of a segment that circles or whirls more often, only so many turns at its beginning and as many
// at its end are sampled finely.
inline constexpr double kTurnsDrawn = 20;

// Whether the curve from one point of a path to the next is drawn.  It is, unless the path jumps
// between them.  In the orbital plane it is drawn only where the step is also small.
bool is_joined(const PathPoint& a, const PathPoint& b);
bool is_joined_in_plane(const PathPoint& a, const PathPoint& b);

// Whether the observer is somewhere else at b, which belongs to the segment after that of a: its r
// or its region is another.
bool is_jump(const PathPoint& a, const PathPoint& b);

// Where t = 0 lies in the Penrose diagram, and why it lies there.
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

// Samples the path at about 2000 even instants, at least 48 to a segment.  More are added wherever
// the curve turns by more than 2.5 degrees about the hole, r changes by more than 4 %, or the curve
// in the Penrose diagram moves by more than 1/150 of its height.  There are at most some 1e5
// points.  Where there are too many turns to draw, the instants are out of step with any period of
// the orbit.
//
// The Killing symmetry t -> t + constant moves every point of the Penrose diagram along its curve
// of constant r.  The constant is chosen for each run of segments without a jump.  Its last
// crossing of a horizon lies at the middle of the horizon's line.  Where the past and the future
// horizon are crossed within 16 M, both crossings lie symmetrically.  Where no horizon is crossed,
// the middle of the run is at t = 0.
Path sample_path(const Show& show);

// The smallest of 1, 2 and 5 times a power of ten that is `least` or more.  least > 0.
double round_step(double least);

}  // namespace domefall
