// How the time of rendering is spread over a show's frames.
#pragma once

#include <vector>

#include "pipeline/render/renderer.h"

namespace domefall {

// For each of these frames, the processor time that it takes, in units of their mean.  Some frames
// spread over them are rendered at a reduced size, at one instant, and counted as often as an open
// shutter has instants; between them the cost is interpolated.  `frames` are sorted; an empty list
// gives an empty one.  Takes half a second of processor time or so.  `renderer` is one of the show.
std::vector<double> relative_costs(const Show& show, const std::vector<int>& frames,
                                   Renderer& renderer);

}  // namespace domefall
