// The sections that shape the picture: `stars`, `exposure`, `grade` and `output`.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

PointSpreadLaw read_point_spread(const Section& show);
Exposure read_exposure(const Section& show);
GradeSettings read_grade(const Section& show, const Lookup& lookup);
GradedFormat read_graded_format(const Section& show);

}  // namespace domefall
