// The keys of show files, and what each may be.  keys.cpp has a row for each key, as
// docs/show-format.md shows it, in a table for each section:
//     | `height_deg` | above 0, at most 60: of a capital letter | [2] |
//     | `align` | `left`, `centre` or `right`: of lines of different lengths | [`centre`] |
// The second cell has the range and the unit of a number ("above A", "at least A", "A to B", "A to
// below B", ", at most B", ", below B"), or the words that the key may be, up to a colon.  A number
// without a unit has that of its key's name.  Anything else is for the reader of docs alone, as is
// what follows the colon, and a default that is not in brackets.
#pragma once

#include <string_view>
#include <vector>

#include "pipeline/show/file/item.h"

namespace domefall {

struct Key {
  std::string_view name, value, fallback;  // the cells of its row

  // What these cells say.  Throws std::logic_error where they do not say it.
  Range range() const;
  std::vector<std::string_view> words() const;
  double number() const;          // the default
  std::string_view word() const;  // the default, or an empty text
};

// Returns the keys of a table, such as "exposure".  Throws std::out_of_range for any other name.
const std::vector<Key>& keys_of(std::string_view table);

// Returns all rows, each table's below a line "## NAME".
std::string_view rows_of_keys();

}  // namespace domefall
