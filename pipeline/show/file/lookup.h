// These find the files and the places on the sky that a show names.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "pipeline/show/file/item.h"
#include "pipeline/show/show.h"
#include "pipeline/sources/stars/solar_system.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {

// Returns a name in the form in which places are compared: in lower case, without blanks, '_', '-',
// apostrophes, full stops and '*', and without the leading zeros of numbers.  "messier" before a
// number becomes "m", and "center" at the end becomes "centre".  So "Messier 31", "m_31" and "M031"
// are one.
std::string folded_place_name(std::string_view name);

// SkyPlaces know the places on the sky that bear names: stars, constellations, nebulae, clusters,
// galaxies.
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

// Reads a table with the columns constellation, abbreviation, line, ra_deg and dec_deg (J2000), and
// returns the figures by both names, folded as those of places.  Throws InputError naming the file.
std::map<std::string, SkyFigure> read_sky_figures(const std::filesystem::path& file);

class Lookup {
 public:
  // `folder` is that of the show file, empty if the file was named without one.
  explicit Lookup(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Finds a regular, readable file of that name beside the show or, failing that, in the working
  // folder.
  std::optional<std::filesystem::path> find(const std::string& name) const;
  // Finds a file in the same way, and reports one that is not found.  Another machine may have a
  // file that is missing here, but a folder can be no file of a show anywhere.
  std::optional<std::filesystem::path> file(const Item& item, const std::string& name) const;
  // Finds a picture in the same way, and reports one that `read` throws an InputError about.
  std::optional<std::filesystem::path> picture(const Item& item,
                                               void (*read)(const std::filesystem::path&)) const;
  // Finds one of the files that come with Domefall.  A missing one is reported at `item`, which
  // needs it.
  std::optional<std::filesystem::path> shipped(const Item& item, std::string_view name) const;

  // Finds the catalogue that fetch_stars makes, beside the show, in the working folder or among the
  // shipped files.  If it is in none of them, the one that comes with Domefall stands in.
  std::optional<std::filesystem::path> deepest_stars(const Item& item) const;

  // Planets, Sun and Moon have the places of this year, the show's begins_year.  Without a year
  // their names are mistakes.
  void set_year(std::optional<double> year) { year_ = year; }

  // Returns the place of a name: that of a planet, the Sun or the Moon, of a star of the shipped
  // catalogue, or else of an entry of the shipped table of places.  The catalogue is read when the
  // first place is named that is no planet, and the table when a name is no star's.  `words` are
  // what the item could have been besides, for the message about an unknown name.
  std::optional<SkyDirection> place(const Item& item, std::span<const std::string_view> words = {});

  // Returns the figure of a constellation by its Latin name or its abbreviation.
  std::optional<SkyFigure> figure(const Item& item);

 private:
  std::optional<SkyDirection> find_place(const Item& item, const std::string& name);
  std::optional<SkyDirection> solar_place(const Item& item, SolarBody body) const;
  // Reads the stars (0) or the other places (1).  Reports a file that is missing or damaged.
  bool read_places(const Item& item, int table);

  std::filesystem::path folder_;
  std::optional<double> year_;
  SkyPlaces places_;
  int tables_read_ = 0;
  std::map<std::string, SkyFigure> figures_;  // empty until the first is asked for
};

// Reads a place on the sky: its name, {star: NAME}, or {ra_deg: X, dec_deg: Y} in J2000.
std::optional<SkyDirection> read_sky_place(const Item& item, Lookup& lookup,
                                           std::span<const std::string_view> words = {});

}  // namespace domefall
