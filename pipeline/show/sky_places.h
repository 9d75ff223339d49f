// The places on the sky that bear names: stars, constellations, nebulae, clusters, galaxies.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "pipeline/sky/catalogue/star_catalogue.h"

namespace domefall {

// A name as places are compared by: in lower case; without blanks, '_', '-', apostrophes, full
// stops and '*'; "messier" before a number as "m"; "center" at the end as "centre"; numbers without
// leading zeros.  So "Messier 31", "m_31" and "M031" are one.
std::string folded_place_name(std::string_view name);

class SkyPlaces {
 public:
  // Where two places have the same folded name, the one that was added first is found.
  void add(const std::vector<NamedStar>& places);

  std::optional<SkyDirection> find(std::string_view name) const;
  // The name nearest to a misspelt one; empty if none is nearer than a third of its letters (at
  // least two) inserted, deleted, replaced or swapped.  A name with other digits is never near.
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
