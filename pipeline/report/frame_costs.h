// What a frame costs against the number of its stars and the number of its pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/report/frame_errors.h"

namespace domefall {

// One frame.  Rows of one scene differ in stars alone or in pixels alone, and ascend.
struct FrameCostRow {
  std::string scene;
  int size;        // pixels along an edge of the dome
  double pixels;   // inside the dome
  double stars;    // of the catalogue
  double seconds;  // CPU, one thread, of the quickest of several renderings; files are read before
  double copies;   // the same over the CPU seconds of copying the frame's half floats
};

struct FrameCosts {
  std::vector<FrameCostRow> stars;   // against the number of stars, without any background
  std::vector<FrameCostRow> pixels;  // against the number of pixels
  // The paper's own task ([Riazuelo] sec. sec_data): a picture of a million pixels as good as by
  // twice the resolution, with the 250,000 stars of the Henry Draper catalogue.  Rows of one scene,
  // one thread; the errors are those of the sky, measured without stars.
  std::vector<FrameErrorRow> benchmark;
};

// In free fall at 7 M, looking at the hole, and in flat space; stars made up as Tycho-2 counts them
// (made_up_stars.h) and read from a *.stars file, in shows that are read from files, so that all
// they do not say is a show's default.  quick: small frames and few stars.  Throws InputError if a
// shipped asset cannot be read, TemporaryError if there is no room for the catalogue (82 MB).
FrameCosts measure_frame_costs(bool quick);

// Nanoseconds for each further star or pixel, from each row to the next one of its scene.
struct CostSlope {
  std::string scene;
  double from, to;  // stars, or pixels
  double ns;
};
std::vector<CostSlope> slopes(const std::vector<FrameCostRow>& rows, double FrameCostRow::*counted);

// How many times a slope exceeds the one before in its scene, at most: what a cliff would show in.
// Nothing if no scene has two slopes or if one is not positive, which a frame too small to time may
// have.
struct SteepestRise {
  std::string scene;
  double at;  // stars or pixels between the two slopes
  double ratio;
};
std::optional<SteepestRise> steepest_rise(const std::vector<CostSlope>& of);

// All that a scene's rows have cost more than its first one, for each star or pixel more.
double mean_slope(const std::vector<FrameCostRow>& rows, double FrameCostRow::*counted,
                  const std::string& scene);

}  // namespace domefall
