// Frames are cut into chunks that take equal time.
#pragma once

#include <vector>

namespace domefall {

// Cuts frames into at most `most` runs in their order, each of one frame or more.  `costs` has a
// number above 0 for each frame, in seconds or any other unit.  No run costs more than a `most`-th
// of the whole plus its own dearest frame.  So where frames are dear, chunks are short.
std::vector<std::vector<int>> equal_chunks(const std::vector<int>& frames,
                                           const std::vector<double>& costs, int most);

}  // namespace domefall
