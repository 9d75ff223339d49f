// The list `titles` of a show or of one of its segments puts texts on the dome.
#pragma once

#include <vector>

#include "pipeline/show/section.h"
#include "pipeline/show/show.h"

namespace domefall {

// A TitleSpan is the part of the show that titles belong to, in show seconds.  Their times count
// from its beginning, and none lasts beyond its end.
struct TitleSpan {
  double begin_s, end_s;
};

// Reads the titles of a section of a show whose projection and markers are known.
std::vector<Title> read_titles(const Section& section, const TitleSpan& span, const Show& show);

}  // namespace domefall
