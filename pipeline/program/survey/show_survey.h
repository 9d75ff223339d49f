// A survey tells in numbers what a show does: where it goes, how near and how fast, and how far the
// light of its skies is shifted.  It renders no frame.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"

namespace domefall {

// An extreme is a value and the place in the show where it is reached.
struct Extreme {
  double value = 0;
  double time_s = 0;  // show seconds
  int frame = 0;      // the last one that is not later than time_s
  int segment = 0;
};

// A Visit is a stay in a region of one of the universes that follow each other through a charged
// hole.
struct Visit {
  Region region = Region::kI;
  int universe = 0;

  bool operator==(const Visit&) const = default;
};

struct SegmentSurvey {
  std::string type;               // of the trajectory, in the words of show files
  double begin_s = 0, end_s = 0;  // show seconds
  double dissolve_s = 0;
  // Radii are in units of M, and infinite in flat space.  `closest` may lie between two frames: the
  // turning points of an orbit are sought to 1e-7 of its proper time.
  double r_begin = kFlatSpace, r_end = kFlatSpace;
  double l_begin = 0, l_end = 0;  // in a wormhole
  Extreme closest;
  std::vector<Visit> visits;  // in their order
  PerSky<bool> skies;         // those of exteriors that are seen
  double proper_time = 0;     // M (seconds in flat space) that pass in the segment
  // These are M of proper time (seconds in flat space) per second of show, at both ends.
  double rate_begin = 0, rate_end = 0;
};

struct ShowSurvey {
  std::vector<SegmentSurvey> segments;
  std::vector<Visit> visits;       // of all segments
  PerSky<bool> skies;              // seen in any segment
  std::optional<Extreme> closest;  // r (M); none in flat space
  // This is the largest gamma v of a frame's observer against the static one of its place (r > 2,
  // or flat space).  It is missing if no frame is outside.
  std::optional<Extreme> fastest;
  // These are the least and the largest 1 + z of light from a sky that the show lights, over every
  // frame and all directions, inside the image or not.
  std::optional<Extreme> bluest, reddest;
};

// Surveys every segment and every frame.  It takes about 5 microseconds for a frame and 5 ms for a
// segment.  It calls `see`, if there is one, with the state of each frame, whose camera does not
// follow keyframed targets.
ShowSurvey survey(const Show& show, const std::function<void(const FrameState&)>& see = {});

// Returns M of proper time per second of show (seconds in flat space) when `part` of a segment, 0
// to 1, has passed.  It is the quotient of differences over 1e-6 of the segment.
double clock_rate(const Segment& segment, double part);

}  // namespace domefall
