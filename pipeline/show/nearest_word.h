// These functions give messages their words: what the author of a show wrote, and the known word that
// was probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace domefall {

// Returns the known word that is probably meant by another, or an empty text if none is near.  The
// first rule that fits decides:
// - it is equal but for case, '-' and blanks;
// - it is equal but for a unit that was left out (fov for fov_deg);
// - it is at most three insertions, deletions, replacements and swaps of neighbours away, and fewer
//   than half the letters;
// - it is equal but for another unit (from_radius for from_r);
// - it begins with the given word, which has three letters at least.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

// Returns "; did you mean X?", or an empty text if no word is near.  Names a character of the word
// that looks like another one, unless the known words have such characters, too.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

// Returns the optimal string alignment distance (restricted Damerau-Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

// Returns the words as a list for a sentence: "a, b or c".
std::string listed(std::span<const std::string_view> words);

// Returns a piece of the user's text for a message.  It is cut after 40 characters, and control
// characters become blanks.
std::string shown(std::string_view text);

}  // namespace domefall
