#include "pipeline/show/nearest_word.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

std::string folded(std::string_view word) {
  std::string out;
  for (const char c : word)
    out.push_back(c == '-' || c == ' '
                      ? '_'
                      : static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
  return out;
}

// Returns a key without its last part, which is the unit in keys such as from_r.  A key without '_'
// stays as it is.
std::string_view without_unit(std::string_view key) { return key.substr(0, key.rfind('_')); }

// Returns the word that is the fewest edits away, of those that are near enough.  Of several at one
// distance it is the first, since only a smaller distance replaces it.
std::string_view fewest_edits(std::string_view wanted, std::span<const std::string_view> known) {
  std::string_view nearest;
  std::size_t least = 4;
  for (const std::string_view k : known) {
    const std::size_t distance = edit_distance(wanted, folded(k));
    if (distance < least && 2 * distance < std::max(wanted.size(), k.size()))
      least = distance, nearest = k;
  }
  return nearest;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // The rows hold the distances from the beginnings of b: `row` for the first i letters of a,
  // `last` for one letter fewer and `before` for two fewer, which a swap of neighbours needs.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      // The distance of two beginnings is the least of three: one letter less of a or of b, each
      // with an edit more, or one less of both, with an edit more unless these two agree (Wagner
      // and Fischer 1974).
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known) {
  if (word.empty() || word.size() > 60) return {};  // no key is that long
  const std::string wanted = folded(word);
  const auto first = [&](auto&& fits) {
    const auto at = std::ranges::find_if(known, fits);
    return at == known.end() ? std::string_view() : *at;
  };
  using View = std::string_view;
  View near = first([&](View k) { return folded(k) == wanted; });
  if (near.empty()) near = first([&](View k) { return folded(k).starts_with(wanted + "_"); });
  if (near.empty()) near = fewest_edits(wanted, known);
  if (near.empty()) near = first([&](View k) { return without_unit(k) == without_unit(wanted); });
  if (near.empty() && wanted.size() > 2)
    near = first([&](View k) { return folded(k).starts_with(wanted); });
  return near;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view nearest = nearest_word(word, known);
  const bool plain =
      std::ranges::all_of(known, [](std::string_view each) { return odd_character(each).empty(); });
  const std::string odd = plain ? odd_character(word) : "";
  return (odd.empty() ? "" : "; it " + odd) +
         (nearest.empty() ? "" : "; did you mean " + std::string(nearest) + "?");
}

std::string listed(std::span<const std::string_view> words) {
  std::string out;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) out += k + 1 == words.size() ? " or " : ", ";
    out += words[k];
  }
  return out;
}

std::string shown(std::string_view text) {
  std::string out;
  int characters = 0;
  for (const char c : text) {
    // A character is counted at its first byte, so that none is cut in two.
    if (!continues_character(c) && ++characters > 40) return out + "...";
    out.push_back(static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c);
  }
  return out;
}

}  // namespace domefall
