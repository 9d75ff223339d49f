// What the author of a show probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace domefall {

// The known word that is probably meant by another, tried in this order: equal but for case, '-' and
// blanks; equal but for a unit that was left out (fov for fov_deg); at most three insertions,
// deletions, replacements and swaps of neighbours away, and fewer than half the letters; equal but
// for another unit (from_radius for from_r); a beginning of it (three letters at least).  Empty if
// none is near.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

// "; did you mean X?", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

// Optimal string alignment (restricted Damerau-Levenshtein) distance.
std::size_t edit_distance(std::string_view a, std::string_view b);

// "a, b or c"
std::string listed(std::span<const std::string_view> words);

}  // namespace domefall
