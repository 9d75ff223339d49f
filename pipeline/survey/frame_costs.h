// The time of rendering is spread unevenly over a show's frames.
#pragma once

#include <vector>

#include "pipeline/render/renderer.h"

namespace domefall {

// Returns, for each of these frames, the processor time that its light takes.  The unit is the mean
// of all, and the times are all 0 if nothing takes time.  The light is measured at both ends of
// each segment, and at some frames between them.  It is rendered at a reduced size and at one
// instant, and it counts as often as an open shutter has instants.  Between these frames the cost
// is interpolated.  A show of very many segments is sampled evenly.  `frames` are sorted, and an
// empty list gives an empty one.  `renderer` is one of the show.  The measurement takes about a
// third of a second of processor time.
std::vector<double> relative_light_costs(const Show& show, const std::vector<int>& frames,
                                         Renderer& renderer);

}  // namespace domefall
