// A plan's frames are cut into chunks that take equal time.
#pragma once

#include <vector>

#include "farm/plan.h"
#include "pipeline/show/show.h"

namespace domefall {

// Cuts frames into at most `most` runs in their order, each of one frame or more.  `costs` has a
// number above 0 for each frame, in seconds or any other unit.  No run costs more than a `most`-th
// of the whole plus its own dearest frame.  So where frames are dear, chunks are short.
std::vector<std::vector<int>> equal_chunks(const std::vector<int>& frames,
                                           const std::vector<double>& costs, int most);

struct Chunking {
  int frames = 0;  // of a chunk; 0: as many as take equal time
  bool only_printed = false;
};

// Renders a few small frames of the show, and adds chunks of these frames to the plan.  Throws
// InputError for more chunks than the engine takes, and as require_room().
void add_chunks(FarmPlan& plan, const Chunking& asked, const Show& show,
                const std::vector<int>& frames);

}  // namespace domefall
