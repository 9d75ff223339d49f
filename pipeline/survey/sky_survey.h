// Which files a show's skies are made of, and which stars are seen both as stars and in a map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/show.h"
#include "pipeline/survey/show_survey.h"
#include "trajectories/sky_region.h"

namespace domefall {

struct SkySources {
  SkyRegion region;
  std::vector<int> segments;               // that see it, ascending from 0
  bool throughout = true;                  // no segment has another background in this region
  const PanoramaSky* panorama = nullptr;   // the show's own; null without one
  std::string map;                         // name of its file; empty without one
  std::optional<double> map_fainter_than;  // SkyOrigin::fainter_than
  std::string catalogue;                   // name of the file; empty without one
  std::size_t stars = 0;                   // so many are drawn
  double faintest = 0;                     // V of the faintest of them
  // Light of the stars that are drawn though the map has theirs, as a mean over the sky, in stars
  // of V = 10 per square degree.
  double twice = 0;
};

// More light than this is worth a warning: 1 % of all starlight.
inline constexpr double kMuchTwice = 1;

// The sky of region I, that of region III where it differs, and a panorama of region IV, in the
// segments that see them: once for each of the backgrounds that segments have.  A catalogue is
// counted to the deepest limit that keyframes reach in those segments.  Throws InputError if a file
// cannot be read.
std::vector<SkySources> survey_skies(const Show& show, const ShowSurvey& survey);

// ", in segments 1 and 3", or nothing for a sky that the region has throughout.
std::string segments_text(const SkySources& sources);

// "the stars of stars.csv from V = 6.5 to 8 are seen twice: ...": what a warning says.
std::string counted_twice_text(const SkySources& sources);

}  // namespace domefall
