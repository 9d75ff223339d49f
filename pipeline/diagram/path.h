// The path of a show's observer, sampled finely enough to be drawn as a smooth curve.
#pragma once

#include <vector>

#include "pipeline/diagram/penrose.h"
#include "pipeline/show/show.h"

namespace domefall {

struct PathPoint {
  double time_s = 0;  // of the show
  int segment = 0;
  Region region = Region::kI;
  double r = kFlatSpace;  // M
  double azimuth = 0;     // radians in the orbital plane from the show's start, in (-pi, pi]
  double swept = 0;       // radians since the start of the trajectory, unbounded
  double speed = 0;       // against the reference tetrad; in flat space against the sky
  PenrosePoint penrose;   // unset in flat space
  bool is_in_drawn_turn = true;
};

// Circles and whirls: of a segment that goes around more often, only so many turns at its beginning
// and as many at its end are sampled finely.
inline constexpr double kTurnsDrawn = 20;

// Whether the curve from one point to the next of a path is drawn: within a segment, and in the
// orbital plane only where the step is small.
bool is_joined(const PathPoint& a, const PathPoint& b);
bool is_joined_in_plane(const PathPoint& a, const PathPoint& b);

// The observer is somewhere else afterwards (r or region change); b belongs to the segment after
// a's.
bool is_jump(const PathPoint& a, const PathPoint& b);

// Where t = 0 lies in the Penrose diagram, and why there.
struct Origin {
  double time_shift = 0;  // M: added to t
  enum class Centre { kMiddle, kCrossing, kTwoCrossings };
  Centre centre = Centre::kMiddle;
};

struct Path {
  // Segment by segment, each in the order of time with its ends included: where two dissolve into each
  // other the second starts before the first one's end.
  std::vector<PathPoint> points;
  std::vector<PathPoint> instants;  // one every `instant_step_s` from the start
  double instant_step_s = 0;
  std::vector<Origin> origins;     // by segment; empty in flat space
  bool has_gaps_in_plane = false;  // more than 2 kTurnsDrawn turns in a segment
};

// About 2000 instants evenly, at least 48 to a segment, and more wherever the curve turns by more
// than 2.5 degrees about the hole, r changes by more than 4 %, or the Penrose diagram is crossed by
// more than 1/150 of its height.  At most some 1e5 points.
// Where there are too many turns to draw, r is sampled as it comes, out of step with any period.
//
// The Killing symmetry t -> t + constant moves every point of the Penrose diagram along its curve of
// constant r.  The constant is chosen for each run without a jump: its last crossing of a horizon lies at
// the middle of its line; or, where the past and the future horizon are crossed within 16 M, both lie
// symmetrically.  Where none is crossed, the middle of the run is at t = 0.
Path sample_path(const Show& show);

// 1, 2 or 5 times a power of ten, the least that is `least` or more; least > 0.
double round_step(double least);

}  // namespace domefall
