// The sections `grade` and `dome` of a show say what is made of its scene-linear frames.
#pragma once

#include "pipeline/show/lookup.h"
#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// Reads `grade`.  The shipped configuration stands in where none is named.
GradeSettings read_grade(const Section& show, const Lookup& lookup);

// Reads `dome: {light, reflectance}` for a show of this projection.  Only a domemaster can have the
// light of the dome simulated or compensated.
DomeSettings read_dome(const Section& show, const Projection& projection);

}  // namespace domefall
