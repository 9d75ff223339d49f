// measure_frame_costs() shows how the cost of a frame grows with the number of its stars and of its
// pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/report/frame_errors.h"

namespace domefall {

// A FrameCostRow is the cost of one frame.  The rows of one scene ascend in stars or in pixels, and
// the other number stays the same.
struct FrameCostRow {
  std::string scene;
  int size;        // pixels along an edge of the dome
  double pixels;   // inside the dome
  double stars;    // in the catalogue
  double seconds;  // CPU, one thread, of the quickest of several renderings; files are read before
  double copies;   // the same over the CPU seconds of copying the frame's half floats
};

struct FrameCosts {
  std::vector<FrameCostRow> stars;   // against the number of stars, without any background
  std::vector<FrameCostRow> pixels;  // against the number of pixels
  // The benchmark is the paper's own task ([Riazuelo] sec. sec_data): a frame of a million pixels,
  // as good as one made at twice the resolution, with the 250,000 stars of the Henry Draper
  // catalogue.  All rows are of one scene and one thread.  Their errors are those of the sky,
  // without stars.
  std::vector<FrameErrorRow> benchmark;
};

// Measures frames of an observer who falls freely at 7 M and faces the hole, or who is in flat
// space.  The stars are made up with the numbers of Tycho-2 (made_up_stars.h).  Both the catalogue
// and the shows are read from files, so everything that a show does not say has its default.  If
// quick, the frames are small and the stars are few.  Throws InputError if a shipped asset cannot
// be read, and TemporaryError if there is no room for the catalogue (82 MB).
FrameCosts measure_frame_costs(bool quick);

// A CostSlope is the time that each further star or pixel takes, from one row of a scene to the
// next.
struct CostSlope {
  std::string scene;
  double from, to;  // stars, or pixels
  double ns;        // for each
};
std::vector<CostSlope> slopes(const std::vector<FrameCostRow>& rows, double FrameCostRow::*counted);

// A SteepestRise is the largest ratio of a slope to the one before it in its scene.  A large one
// would reveal a cliff.  There is none if no scene has two slopes, or if any slope is not positive,
// as happens in frames too small to be timed.
struct SteepestRise {
  std::string scene;
  double at;  // stars or pixels between the two slopes
  double ratio;
};
std::optional<SteepestRise> steepest_rise(const std::vector<CostSlope>& of);

// Returns the slope (ns) from the first row of a scene to its last, or 0 if the scene has fewer
// than two rows.
double mean_slope(const std::vector<FrameCostRow>& rows, double FrameCostRow::*counted,
                  const std::string& scene);

}  // namespace domefall
