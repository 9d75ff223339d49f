// This file makes a contact sheet of finished frames.
#pragma once

#include <string>
#include <vector>

#include "pipeline/cli/graded_frames.h"

namespace domefall {

// Returns a sheet of these frames with a label each.  They are read on several threads.  Throws as
// GradedFrames::read().
GradedFrame sheet_of_frames(const GradedFrames& from, const Show& show,
                            const std::vector<int>& frames, const std::vector<std::string>& labels,
                            int threads);

}  // namespace domefall
