#include "pipeline/show/lookup.h"

#include <limits>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/show/assets.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/show/section.h"
#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace fs = std::filesystem;

std::optional<fs::path> Lookup::find(const std::string& name) const {
  for (const fs::path& file : {folder_ / name, fs::path(name)})
    if (is_readable_file(file)) return file;
  return std::nullopt;
}

std::optional<fs::path> Lookup::file(const Item& item, const std::string& name) const {
  if (auto found = find(name)) return found;
  const fs::path beside = folder_ / name;
  const std::string named = "names the file '" + shown(name) + "', ";
  std::error_code error;
  // Only a file that is missing or cannot be read may be in order on another machine.
  if (fs::is_directory(beside, error))
    item.fail(named + "which is a folder");
  else if (fs::is_regular_file(beside, error))
    item.miss_file(named + "which cannot be read");
  else if (fs::exists(beside, error))
    item.fail(named + "which is no regular file");
  else
    item.miss_file(named + "which is neither beside the show nor in the working folder");
  return std::nullopt;
}

std::optional<fs::path> Lookup::shipped(const Item& item, std::string_view name) const {
  fs::path file = shipped_asset(name);
  if (is_readable_file(file)) return file;
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
    // A show can name a star of any magnitude.
    places_.add(stars ? read_star_catalogue(*file, std::numeric_limits<double>::infinity()).names
                      : read_sky_places(*file));
  } catch (const InputError& error) {
    item.fail((stars ? "needs the star catalogue: " : "needs the table of places on the sky: ") +
              std::string(error.what()));
    return false;
  }
  return true;
}

std::optional<SkyDirection> Lookup::find_place(const Item& item, const std::string& name) {
  constexpr int kTables = 2;
  auto found = places_.find(name);
  // The tables are read one after the other until one has the name.
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
  // If a table could not be read, that has been reported, and the name may be right.
  if (item.problems->count() > reported) return std::nullopt;
  std::string near(nearest_word(*name, words));
  if (near.empty() && name->size() < 60) near = places_.nearest(*name);
  item.fail((words.empty() ? "" : "must be " + listed(words) + ", or a place on the sky; it ") +
            "names '" + shown(*name) +
            "', which is no star, constellation or object that Domefall knows" +
            (near.empty() ? "" : "; did you mean " + near + "?"));
  return std::nullopt;
}

std::optional<SkyDirection> read_sky_place(const Item& item, Lookup& lookup,
                                           std::span<const std::string_view> words) {
  if (is_text_or_number(item)) return lookup.place(item, words);
  const Section place(item, {"ra_deg", "dec_deg", "star"});
  if (place.find("star")) {
    place.one_of({"star", "ra_deg"});
    place.one_of({"star", "dec_deg"});
    return lookup.place(*place.find("star"));
  }
  const auto ra = place.required_number("ra_deg", kDegrees.within(0, 360));
  const auto dec = place.required_number("dec_deg", kDegrees.within(-90, 90));
  if (!ra || !dec) return std::nullopt;
  return sky_direction(*ra, *dec);
}

}  // namespace domefall
