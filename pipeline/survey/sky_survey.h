// Which files a show's skies are made of, and which stars are seen both as stars and in a map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/show.h"
#include "trajectories/sky_region.h"

namespace domefall {

struct SkySources {
  SkyRegion region;
  std::string map;                         // name of the file; empty without one
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

// What region I shows and, of a show that sees it and where it differs, region III.  A catalogue is
// counted to the magnitude that the show begins with.  Throws InputError if a file cannot be read.
std::vector<SkySources> survey_skies(const Show& show, bool sees_region_three);

// "the stars of region_I from V = 6.5 on are also in the map x.sky ...": what a warning says.
std::string counted_twice_text(const SkySources& sources);

}  // namespace domefall
