// What the stages of a frame cost, and the plan of the frame in words: what `render --explain` prints.
#pragma once

#include <cstddef>
#include <string>

#include "pipeline/render/scene/frame_plan.h"

namespace domefall {

// Wall-clock seconds and counts.
struct StageTimes {
  double load_s = 0, tables_s = 0, stars_s = 0, grid_s = 0, pixels_s = 0;
  double traced_fraction = 0;  // of the sky's pixels, those with a view ray of their own; 0 to 1
  std::size_t table_nodes = 0, images = 0;
  int tables_made = 0;  // the others were kept from the frame before
  // Instants of which a frame with an open shutter is the mean.  The times are those of all of them.
  int instants = 1;

  // Adds the times and counts of another instant of the frame; the fraction and the nodes are those of the
  // larger one.
  void add(const StageTimes& other);
};

// One line for each thing that is made or left out.
std::string describe(const FramePlan& plan, const StageTimes& times);

}  // namespace domefall
