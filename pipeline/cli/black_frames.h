// This file finds the black frames of a folder that ought not to be black.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/farm/folder_findings.h"
#include "pipeline/grade/grader.h"
#include "pipeline/show/show.h"

namespace domefall {

// Returns, sorted, those of the black frames that ought to have light.  Each is rendered again,
// small, and ought to have light if that is more than ten times as bright as a frame may be that
// counts as black.  So frames in the dark of a fade, and frames that no light reaches, are not
// returned.  `grader` is the show's, or null.  Throws as Renderer.
std::vector<int> unexpectedly_black(const Show& show, const FolderFindings& found,
                                    const Grader* grader, int threads);

}  // namespace domefall
