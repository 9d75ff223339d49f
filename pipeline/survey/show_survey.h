// What a show does, in numbers: where it goes, how near, how fast, and how far the light of its skies is
// shifted.  Nothing is rendered.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"

namespace domefall {

// A value and where in the show it is reached.
struct Extreme {
  double value = 0;
  double time_s = 0;  // show seconds
  int frame = 0;      // the last one that is not later
  int segment = 0;
};

struct SegmentSurvey {
  std::string type;               // of the trajectory, in the words of show files
  double begin_s = 0, end_s = 0;  // show seconds
  double dissolve_s = 0;
  // M; infinite in flat space.  `closest` holds between the frames too: the turning points of an orbit
  // are sought to 1e-7 of its proper time.
  double r_begin = kFlatSpace, r_end = kFlatSpace;
  Extreme closest;
  std::vector<Region> regions;  // in the order visited, each time it is entered
  double proper_time = 0;       // M (seconds in flat space) that pass
  // M of proper time per second of show (seconds in flat space), at both ends.
  double rate_begin = 0, rate_end = 0;
};

struct ShowSurvey {
  std::vector<SegmentSurvey> segments;
  std::vector<Region> regions;     // in the order visited
  std::optional<Extreme> closest;  // r (M); none in flat space
  // Of the frames' observers: gamma v against the static observer of their place, r > 2 or flat space.
  // None if no frame is outside.
  std::optional<Extreme> fastest;
  // Least and largest 1 + z of light from a sky that the show lights, over every frame and every direction
  // that an observer could look along (in the picture or not).
  std::optional<Extreme> bluest, reddest;
};

// About 5 microseconds a frame and 5 ms a segment.
ShowSurvey survey(const Show& show);

// How a segment's clock runs at a part of it, 0 to 1: M of proper time per second of show.  A difference
// over 1e-6 of the segment.
double clock_rate(const Segment& segment, double part);

// Against the static observer at the same r > 2, or in flat space: gamma v (components along R, Theta,
// Phi of the state's tetrad, R growing with r).
V3d static_celerity(const ObserverState& observer);

// Least and largest observed/emitted frequency of light that comes from infinity, over the directions in
// which the sky of the observer's own side (far: the other one, inside the horizon) is seen; nothing where
// it is not.  Straight light: of an observer at r > 2 in a show without lensing.
//
// A look along the unit vector m of the rain frame has, with c = gamma v,
//     g(m) = (gamma + c.m)/(1 + sqrt(2/r) m_R)
// (Doppler factor, and the conserved energy of light in rain, [Riazuelo] eq. nprime_aber, omprime_aber).
// In the plane of R and c, where the extremes lie, dg = 0 where
//     c_t cos a + (s gamma - c_R) sin a + s c_t = 0,   m = (cos a, sin a);
// else they lie at the silhouette's edge.  Exact to rounding, but as 1 + s m_R is small.
struct ShiftRange {
  double least, largest;
};
std::optional<ShiftRange> frequency_range(const ObserverState& observer, bool far, bool straight);

}  // namespace domefall
