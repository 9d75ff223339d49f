#include "pipeline/show/sky_places.h"

#include <algorithm>

#include "pipeline/image/csv_file.h"
#include "pipeline/show/nearest_word.h"
#include "trajectories/equatorial.h"

namespace domefall {
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
    // A zero at the front of a number goes when another digit follows.
    const bool leading_zero =
        folded.ends_with('0') && (folded.size() == 1 || !is_digit(folded[folded.size() - 2]));
    if (leading_zero && is_digit(c)) folded.pop_back();
    folded.push_back(c);
  }
  constexpr std::string_view kMessier = "messier";
  // Before a number the word names the catalogue, and elsewhere it may be a part of a name.
  if (folded.size() > kMessier.size() && is_digit(folded[kMessier.size()]))
    replace_word(folded, kMessier, "m", true);
  // The American spelling ends names such as galactic_center.
  replace_word(folded, "center", "centre", false);
  return folded;
}

void SkyPlaces::add(const std::vector<NamedStar>& places) {
  for (const NamedStar& place : places) {
    folded_.push_back(folded_place_name(place.name));
    // emplace() keeps an entry that is there, so that the place that was added first is found.
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
    // The distance is at least the difference of the lengths.
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

}  // namespace domefall
