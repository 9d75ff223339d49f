// The show's `grade` and `dome`: what is made of scene-linear frames.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads `grade`; the shipped configuration stands in for one that is not named.
GradeSettings read_grade(const Section& show, const Lookup& lookup);

// Reads `dome: {light, reflectance}` for a show of this projection, which must be a dome's.
DomeSettings read_dome(const Section& show, const Projection& projection);

}  // namespace domefall
