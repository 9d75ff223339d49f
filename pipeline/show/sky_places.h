// SkyPlaces know the places on the sky that bear names: stars, constellations, nebulae, clusters,
// galaxies.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "pipeline/sky/catalogue/star_catalogue.h"

namespace domefall {

// Returns a name in the form in which places are compared: in lower case, without blanks, '_', '-',
// apostrophes, full stops and '*', and without the leading zeros of numbers.  "messier" before a
// number becomes "m", and "center" at the end becomes "centre".  So "Messier 31", "m_31" and "M031"
// are one.
std::string folded_place_name(std::string_view name);

class SkyPlaces {
 public:
  // Adds places.  Where two places have the same folded name, the one that was added first is
  // found.
  void add(const std::vector<NamedStar>& places);

  // Returns the place of a name, whose folded form is looked up.
  std::optional<SkyDirection> find(std::string_view name) const;
  // Returns the name nearest to a misspelt one, or an empty text if none is near.  A near name has
  // at most a third of its letters (at least two) inserted, deleted, replaced or swapped.  A name
  // with other digits is never near.
  std::string nearest(std::string_view name) const;

 private:
  std::vector<NamedStar> places_;
  std::vector<std::string> folded_;  // the name of each
  std::unordered_map<std::string, std::size_t> by_name_;
};

// Reads a table with the columns name, ra_deg and dec_deg (J2000).  Throws InputError naming the
// file.
std::vector<NamedStar> read_sky_places(const std::filesystem::path& file);

}  // namespace domefall
