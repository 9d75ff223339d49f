// Which black frames ought not to be.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/farm/folder_findings.h"
#include "pipeline/grade/grader.h"
#include "pipeline/show/show.h"

namespace domefall {

// Those of the black frames that the renderer, asked for a small one, finds ten times as bright as
// the brightest black: sorted.  In a fade's dark, and where no light comes, it finds none.
// `grader` is the show's, or null.  Throws as Renderer.
std::vector<int> unexpectedly_black(const Show& show, const FolderFindings& found,
                                    const Grader* grader, int threads);

}  // namespace domefall
