#include "pipeline/show/file/lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "pipeline/base/csv_file.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/show/assets.h"
#include "pipeline/show/file/section.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace fs = std::filesystem;
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Returns the digits of a text, run together, by which names from catalogues are told apart.
std::string digits_of(std::string_view text) {
  std::string digits;
  std::ranges::copy_if(text, std::back_inserter(digits), is_digit);
  return digits;
}

// Puts `to` in the place of `from` at the front or the end of a name.  A name without the word
// stays as it is.
void replace_word(std::string& name, std::string_view from, std::string_view to, bool in_front) {
  if (in_front ? name.starts_with(from) : name.ends_with(from))
    name.replace(in_front ? 0 : name.size() - from.size(), from.size(), to);
}

}  // namespace

std::string folded_place_name(std::string_view name) {
  // folded_star_name() has dropped blanks and '_' and made the letters lower case.
  std::string folded;
  for (const char c : folded_star_name(name)) {
    if (std::string_view("-'.*").find(c) != std::string_view::npos) continue;
    const bool leading_zero =
        folded.ends_with('0') && (folded.size() == 1 || !is_digit(folded[folded.size() - 2]));
    if (leading_zero && is_digit(c)) folded.pop_back();
    folded.push_back(c);
  }
  constexpr std::string_view kMessier = "messier";
  // Before a number the word names the catalogue, and elsewhere it may be a part of a name.
  if (folded.size() > kMessier.size() && is_digit(folded[kMessier.size()]))
    replace_word(folded, kMessier, "m", true);
  replace_word(folded, "center", "centre", false);
  return folded;
}

void SkyPlaces::add(const std::vector<NamedStar>& places) {
  for (const NamedStar& place : places) {
    folded_.push_back(folded_place_name(place.name));
    by_name_.emplace(folded_.back(), places_.size());
    places_.push_back(place);
  }
}

std::optional<SkyDirection> SkyPlaces::find(std::string_view name) const {
  const auto found = by_name_.find(folded_place_name(name));
  if (found == by_name_.end()) return std::nullopt;
  return places_[found->second].direction;
}

std::string SkyPlaces::nearest(std::string_view name) const {
  const std::string wanted = folded_place_name(name), digits = digits_of(wanted);
  // `least` is the smallest distance that is too large, until a nearer name lowers it.
  std::size_t least = std::max<std::size_t>(2, wanted.size() / 3) + 1;
  std::string nearest;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const std::string& known = folded_[k];
    const std::size_t longer = std::max(known.size(), wanted.size());
    if (longer - std::min(known.size(), wanted.size()) >= least) continue;
    // Two catalogue numbers that differ name two objects, however near they are.
    if (digits_of(known) != digits) continue;
    const std::size_t distance = edit_distance(known, wanted);
    if (distance < least) least = distance, nearest = places_[k].name;
  }
  return nearest;
}

std::vector<NamedStar> read_sky_places(const std::filesystem::path& file) {
  CsvFile row(file, {"name", "ra_deg", "dec_deg"});
  std::vector<NamedStar> places;
  while (row.next())
    places.push_back(
        {std::string(row.text("name")),
         sky_direction(row.required("ra_deg", 0, 360), row.required("dec_deg", -90, 90))});
  return places;
}

std::map<std::string, SkyFigure> read_sky_figures(const std::filesystem::path& file) {
  CsvFile row(file, {"constellation", "abbreviation", "line", "ra_deg", "dec_deg"});
  std::map<std::string, SkyFigure> figures;
  while (row.next()) {
    const auto line = static_cast<std::size_t>(row.required("line", 1, 1000));
    const SkyDirection place =
        sky_direction(row.required("ra_deg", 0, 360), row.required("dec_deg", -90, 90));
    for (const char* column : {"constellation", "abbreviation"}) {
      SkyFigure& figure = figures[folded_place_name(row.text(column))];
      figure.resize(std::max(figure.size(), line));
      figure[line - 1].push_back(place);
    }
  }
  return figures;
}

std::optional<fs::path> Lookup::find(const std::string& name) const {
  // The folder of the show comes first, so that a show moves to another machine together with its
  // files.  An absolute name replaces the folder, and both candidates are then the same file.
  for (const fs::path& file : {folder_ / name, fs::path(name)})
    if (is_readable_file(file)) return file;
  return std::nullopt;
}

std::optional<fs::path> Lookup::file(const Item& item, const std::string& name) const {
  if (auto found = find(name)) return found;
  const fs::path beside = folder_ / name;
  const std::string named = "names the file '" + shown(name) + "', ";
  std::string odd = odd_character(name, false);
  if (!odd.empty()) odd.insert(0, "; the name ");
  std::error_code error;
  // Only a file that is missing or cannot be read may be in order on another machine.
  if (fs::is_directory(beside, error))
    item.fail(named + "which is a folder");
  else if (fs::is_regular_file(beside, error))
    item.miss_file(named + "which cannot be read");
  else if (fs::exists(beside, error))
    item.fail(named + "which is no regular file");
  else
    item.miss_file(named + "which is neither beside the show nor in the working folder" + odd);
  return std::nullopt;
}

// A picture is read as a whole, since else its damage would be found after hours of frames.
std::optional<fs::path> Lookup::picture(const Item& item, void (*read)(const fs::path&)) const {
  const auto name = read_text(item);
  auto found = name ? file(item, *name) : std::nullopt;
  if (!found) return std::nullopt;
  try {
    read(*found);
  } catch (const InputError& error) {
    return item.fail(std::string("cannot be used: ") + error.what());
  }
  return found;
}

std::optional<fs::path> Lookup::shipped(const Item& item, std::string_view name) const {
  fs::path file = shipped_asset(name);
  if (is_readable_file(file)) return file;
  // The installation is at fault and not the show, so this counts as a missing file, which another
  // machine may have.
  item.miss_file("needs Domefall's own file " + std::string(name) + ", which is missing from " +
                 assets_folder().string() +
                 " (the variable DOMEFALL_ASSETS can name another folder)");
  return std::nullopt;
}

std::optional<fs::path> Lookup::deepest_stars(const Item& item) const {
  if (auto found = find(std::string(kDeepestStars))) return found;
  const fs::path among_assets = shipped_asset(kDeepestStars);
  if (is_readable_file(among_assets)) return among_assets;
  return shipped(item, kStandardStars);
}

bool Lookup::read_places(const Item& item, int table) {
  const bool stars = table == 0;
  const auto file = shipped(item, stars ? kStandardStars : kSkyPlaces);
  if (!file) return false;
  try {
    places_.add(stars ? read_star_catalogue(*file, std::numeric_limits<double>::infinity()).names
                      : read_sky_places(*file));
  } catch (const InputError& error) {
    // Only what is wrong inside the file is caught.  A TemporaryError, by which the system refuses
    // the file, goes up to the caller of read_show().
    item.fail((stars ? "needs the star catalogue: " : "needs the table of places on the sky: ") +
              std::string(error.what()));
    return false;
  }
  return true;
}

// Returns the place of a body in the show's year, or reports that it is not known then.
std::optional<SkyDirection> Lookup::solar_place(const Item& item, SolarBody body) const {
  const std::string name(kSolarBodyNames[static_cast<std::size_t>(body)]);
  if (!year_)
    return item.fail("names " + name +
                     ", which needs the show's begins_year, since it moves on the sky");
  const YearSpan known = years_of(body);
  if (*year_ >= known.first && *year_ <= known.last) return seen_from_earth(body, *year_);
  return item.fail(
      fmt::format("names {}, whose place is known from {} to {}, but begins_year is {}", name,
                  known.first, known.last, *year_));
}

// Returns the place of a name, or nothing if no table has it or a table cannot be read.  Planets
// need no table.  The stars come before other objects, and SkyPlaces finds what was added first, so
// that a star takes precedence over an object of its name.
std::optional<SkyDirection> Lookup::find_place(const Item& item, const std::string& name) {
  if (const auto body = solar_body(name)) return solar_place(item, *body);
  constexpr int kTables = 2;
  auto found = places_.find(name);
  for (; !found && tables_read_ < kTables; found = places_.find(name))
    if (read_places(item, tables_read_))
      ++tables_read_;
    else
      return std::nullopt;
  return found;
}

std::optional<SkyDirection> Lookup::place(const Item& item,
                                          std::span<const std::string_view> words) {
  const auto name = read_text(item);
  if (!name) return std::nullopt;
  const std::size_t reported = item.problems->count();
  if (auto found = find_place(item, *name)) return found;
  if (item.problems->count() > reported) return std::nullopt;
  // The words that the key takes are few, and so are planets, and both come before thousands of
  // names.  A text of 60 characters is no misspelt name, and its distance to each of them would
  // take long.
  std::string near(nearest_word(*name, words));
  if (near.empty()) near = nearest_word(*name, kSolarBodyNames);
  if (near.empty() && name->size() < 60) near = places_.nearest(*name);
  const std::string odd = odd_character(*name);
  return item.fail(
      (words.empty() ? "" : "must be " + listed(words) + ", or a place on the sky; it ") +
      "names '" + shown(*name) +
      "', which is no star, planet, constellation or object that Domefall knows" +
      (odd.empty() ? "" : "; it " + odd) + (near.empty() ? "" : "; did you mean " + near + "?"));
}

std::optional<SkyFigure> Lookup::figure(const Item& item) {
  const auto name = read_text(item);
  const auto file = name && figures_.empty() ? shipped(item, kFigures) : std::nullopt;
  if (!name || (figures_.empty() && !file)) return std::nullopt;
  try {
    if (file) figures_ = read_sky_figures(*file);
  } catch (const InputError& error) {
    return item.fail("needs the table of figures: " + std::string(error.what()));
  }
  const auto found = figures_.find(folded_place_name(*name));
  if (found != figures_.end()) return found->second;
  std::vector<std::string_view> names;
  names.reserve(figures_.size());
  for (const auto& [known, figure] : figures_) names.push_back(known);
  return item.fail("names '" + shown(*name) + "', which is no constellation" +
                   did_you_mean(folded_place_name(*name), names));
}

std::optional<SkyDirection> read_sky_place(const Item& item, Lookup& lookup,
                                           std::span<const std::string_view> words) {
  // A scalar is a name in any case, also one of digits.  A map is one of the two other forms.
  if (item.node.IsScalar()) return lookup.place(item, words);
  const Section place(item, {"place"});
  if (place.find("star")) {
    place.one_of({"star", "ra_deg"});
    place.one_of({"star", "dec_deg"});
    return lookup.place(*place.find("star"));
  }
  const auto ra = place.required("ra_deg");
  const auto dec = place.required("dec_deg");
  if (!ra || !dec) return std::nullopt;
  return sky_direction(*ra, *dec);
}

}  // namespace domefall
