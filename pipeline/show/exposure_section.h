// The show's `exposure`.
#pragma once

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

Exposure read_exposure(const Section& show);

}  // namespace domefall
