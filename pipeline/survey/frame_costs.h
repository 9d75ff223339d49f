// How the time of rendering is spread over a show's frames.
#pragma once

#include <vector>

#include "pipeline/render/renderer.h"

namespace domefall {

// For each of these frames, the processor time that its light takes, in units of their mean, which
// is 0 for none.  At both ends of each segment, and at some frames between them, it is rendered at
// a reduced size, at one instant, and counted as often as an open shutter has instants; between
// these the cost is interpolated.  A show of very many segments is sampled evenly.  `frames` are
// sorted; an empty list gives an empty one.  Takes a third of a second of processor time or so.
// `renderer` is one of the show.
std::vector<double> relative_light_costs(const Show& show, const std::vector<int>& frames,
                                         Renderer& renderer);

}  // namespace domefall
