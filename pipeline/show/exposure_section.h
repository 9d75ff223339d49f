// The section `exposure` of a show gives the brightness of its frames and the time for which the
// shutter is open.
#pragma once

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

Exposure read_exposure(const Section& show);

}  // namespace domefall
