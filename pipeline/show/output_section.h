// The section `output` of a show says which files are made of its frames.
#pragma once

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads `output: {linear, compression, graded, quality, name, start, digits, per_folder,
// owner}`.
Output read_output(const Section& show);

}  // namespace domefall
