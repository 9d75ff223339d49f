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
  // The error code is not looked at: a path that cannot be examined counts as a missing file.
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
  // The installation is at fault and not the show, so this counts as a missing file, which another
  // machine may have.
  item.miss_file("needs Domefall's own file " + std::string(name) + ", which is missing from " +
                 assets_folder().string() +
                 " (the variable DOMEFALL_ASSETS can name another folder)");
  return std::nullopt;
}

std::optional<fs::path> Lookup::deepest_stars(const Item& item) const {
  if (auto found = find(std::string(kDeepestStars))) return found;
  // Neither place is reported as lacking the file, since the standard catalogue stands in for it.
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
    // Only what is wrong inside the file is caught.  A TemporaryError, by which the system refuses
    // the file, goes up to the caller of read_show().
    item.fail((stars ? "needs the star catalogue: " : "needs the table of places on the sky: ") +
              std::string(error.what()));
    return false;
  }
  return true;
}

// Returns the place of a name, or nothing if no table has it or a table cannot be read.  The stars
// come first, and SkyPlaces finds what was added first, so that a star takes precedence over an
// object of its name.
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
  // The words that the key takes are few, and so they come before thousands of names.  A text of 60
  // characters is no misspelt name, and its distance to each of them would take long.
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
  // A scalar is a name in any case, also one of digits.  A map is one of the two other forms.
  if (is_text_or_number(item)) return lookup.place(item, words);
  const Section place(item, {"ra_deg", "dec_deg", "star"});
  if (place.find("star")) {
    // Each coordinate that stands beside a name is reported by itself.
    place.one_of({"star", "ra_deg"});
    place.one_of({"star", "dec_deg"});
    return lookup.place(*place.find("star"));
  }
  // Both coordinates are read before one that is missing gives up the place, so that one run
  // reports both.
  const auto ra = place.required_number("ra_deg", kDegrees.within(0, 360));
  const auto dec = place.required_number("dec_deg", kDegrees.within(-90, 90));
  if (!ra || !dec) return std::nullopt;
  return sky_direction(*ra, *dec);
}

}  // namespace domefall
