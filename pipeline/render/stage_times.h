// Holds the times that the stages of a frame take, and writes the report of them that
// `render --explain` prints.
#pragma once

#include <cstddef>
#include <string>

#include "pipeline/render/scene/frame_plan.h"

namespace domefall {

struct StageTimes {
  // All times are by the wall clock.  That of the disc is what its tables take.
  double load_s = 0, tables_s = 0, stars_s = 0, grid_s = 0, disc_s = 0, pixels_s = 0, glare_s = 0;
  double traced_fraction = 0;  // the part of the sky's pixels that have view rays of their own
  std::size_t table_nodes = 0, images = 0;
  int tables_made = 0;  // those that were not kept from the frame before
  // The luminance (cd/m^2) that was subtracted as black from the map of each sky that is seen.
  PerSky<double> black{};
  int instants = 1;  // may exceed 1 with an open shutter; the times are then sums over all

  // Adds the times and counts of another instant of the frame.  The traced fraction, the nodes and
  // the blacks become the larger ones of both.
  void add(const StageTimes& other);
};

// Returns the plan and the times as text, with a line for each stage.
std::string describe(const FramePlan& plan, const StageTimes& times);

}  // namespace domefall
