// What tests of imported catalogues share.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "pipeline/sources/stars/catalogue_formats.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/source_tree.h"
#include "trajectories/equatorial.h"

namespace domefall {

// Arcseconds from a place in J2000 degrees.
inline double arcseconds_from(const SkyDirection& star, double ra_deg, double dec_deg) {
  const V3d place = sky_direction(ra_deg, dec_deg).v;
  return std::atan2(star.v.cross(place).length(), star.v.dot(place)) *
         (180 * 3600 / 3.14159265358979);
}

// The star of that identifier; one without a magnitude where there is none.
inline CatalogueStar star_of(const RawCatalogue& catalogue, std::string_view id) {
  for (const CatalogueStar& star : catalogue.stars)
    if (star.id == parse_star_id(id)) return star;
  CatalogueStar none;
  none.v = -1000;
  return none;
}

inline const std::filesystem::path kRows = source_file("tests/reference/stars");

// The folder of a test that imports a catalogue from text.
class Imports : public TestFolder {
 protected:
  std::filesystem::path file(const std::string& text) const {
    put(folder_ / "input", text);
    return folder_ / "input";
  }
  template <class Importing>
  std::string complaint(Importing import, const std::string& text) const {
    return message_of([&] { import({file(text)}); });
  }
};

}  // namespace domefall
