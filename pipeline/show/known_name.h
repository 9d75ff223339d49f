// One place of a show file can refer to another by a name, which is looked up here.
#pragma once

#include <string>
#include <vector>

#include "pipeline/show/nearest_word.h"
#include "pipeline/show/section.h"

namespace domefall {

// Returns what the map `known` has under the name that a section gives under `key`.  Returns null
// if the section gives none, or one that is not known, which is reported.  `missing` begins the
// message.
template <class Known>
const typename Known::mapped_type* find_named(const Section& s, std::string_view key,
                                              const Known& known, const std::string& missing) {
  const Item* name = s.find(key);
  const auto text = name ? read_text(*name) : std::nullopt;
  if (!text) return nullptr;
  const auto found = known.find(*text);
  if (found != known.end()) return &found->second;
  std::vector<std::string_view> names;
  names.reserve(known.size());
  for (const auto& [other, meaning] : known) names.push_back(other);
  name->fail(missing + ": '" + shown(*text) + "'" + did_you_mean(*text, names));
  return nullptr;
}

}  // namespace domefall
