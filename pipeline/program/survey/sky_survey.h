// A sky survey says which files a show's skies are made of, and which stars are seen twice, both as
// stars and in a map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/program/survey/show_survey.h"
#include "pipeline/show/show.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

struct SkySources {
  SkyRegion region;
  std::vector<int> segments;               // those that see it, ascending from 0
  bool throughout = true;                  // no segment has another background in this region
  const PanoramaSky* panorama = nullptr;   // the show's own; null if it has none
  std::string map;                         // name of its file; empty if there is none
  std::string taken;                       // of a picture: what was taken as what (picture_taken)
  std::optional<double> map_fainter_than;  // SkyOrigin::fainter_than
  std::string catalogue;                   // name of the file; empty if there is none
  std::size_t stars = 0;                   // number of stars that are drawn
  double faintest = 0;                     // V of the faintest of them
  std::optional<double> planets_year;      // the planets of this year are among them
  // This is the light of stars that are drawn although the map contains it, as a mean over the sky,
  // in stars of V = 10 per square degree.
  double twice = 0;
};

// More light than this is worth a warning.  It is 1 % of all starlight.
inline constexpr double kMuchTwice = 1;

// Returns the sky of region I, that of region III where it differs, and a panorama of region IV, in
// the segments that see them.  Each appears once for each of the backgrounds that segments give it.
// A catalogue is counted to the deepest limit that keyframes reach in those segments.  Throws
// InputError if a file cannot be read.
std::vector<SkySources> survey_skies(const Show& show, const ShowSurvey& survey);

// Returns a text such as ", in segments 1, 3", or nothing for a sky that the region has throughout.
std::string segments_text(const SkySources& sources);

// Returns the words of a warning: "the stars of stars.csv from V = 6.5 to 8 are seen twice: ...".
std::string counted_twice_text(const SkySources& sources);

}  // namespace domefall
