#include "pipeline/show/file/section.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

// Returns the place of a node, whose line and column yaml-cpp counts from 0 as TextPlace does.
TextPlace place_of(const YAML::Node& node) { return {node.Mark().line, node.Mark().column}; }

std::string join(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

}  // namespace

Section::Section(const Item* item, std::initializer_list<std::string_view> tables) {
  for (const std::string_view table : tables)
    for (const Key& key : keys_of(table))
      if (std::ranges::find(keys_, key.name, &Key::name) == keys_.end()) keys_.push_back(key);
  if (!item) return;
  if (!item->node.IsMap()) {
    item->fail("must be a map of keys (" + listed(known()) + "), got " + kind_of(*item));
    return;  // finds no keys, and reports none as missing
  }
  // The item is emplaced, since its node is const and it cannot be assigned.
  item_.emplace(*item);
  for (const auto& entry : item->node) add(entry.first, entry.second);
}

const Key& Section::row(std::string_view key) const {
  const auto found = std::ranges::find(keys_, key, &Key::name);
  if (found == keys_.end()) throw std::logic_error("no table has the key " + std::string(key));
  return *found;
}

std::vector<std::string_view> Section::known() const {
  std::vector<std::string_view> names;
  names.reserve(keys_.size());
  for (const Key& key : keys_) names.push_back(key.name);
  return names;
}

void Section::add(const YAML::Node& key, const YAML::Node& value) {
  Problems& problems = *item_->problems;
  if (!key.IsScalar()) {
    problems.add(place_of(key), join(item_->path, "?") + " is no key; keys are plain words");
    return;
  }
  const std::string& name = key.Scalar();
  const std::string path = join(item_->path, shown(name));
  if (std::ranges::find(keys_, name, &Key::name) == keys_.end()) {
    const std::string_view nearest = nearest_word(name, known());
    misspelt_.insert(std::string(nearest));
    const std::string odd = odd_character(name);
    problems.add(place_of(key),
                 path + " is an unknown key; " + (odd.empty() ? "" : "it " + odd + "; ") +
                     (nearest.empty() ? "known here: " + listed(known())
                                      : "did you mean " + std::string(nearest) + "?"));
    return;
  }
  // YAML forbids equal keys in one map (YAML 1.2, sec. 3.2.1.1), but yaml-cpp leaves that to its
  // callers.
  if (const auto first = entries_.find(name); first != entries_.end()) {
    problems.add(place_of(key), fmt::format("{} is repeated; it is given at line {} already", path,
                                            first->second.line + 1));
    return;
  }
  // An empty value has no place in the text, so that the key's stands in.
  const bool empty = !value.IsMap() && !value.IsSequence() && !value.IsScalar();
  const TextPlace at = place_of(empty ? key : value);
  entries_.emplace(name, Entry{key.Mark().line, Item{value, at, path, &problems}});
}

const Item* Section::find(std::string_view key) const {
  const auto at = entries_.find(key);
  return at == entries_.end() ? nullptr : &at->second.value;
}

const Item* Section::require(std::string_view key, const std::string& what) const {
  const Item* found = find(key);
  // A section that the show leaves out misses none of its keys.
  if (!found && item_ && !is_misspelt(key))
    item_->problems->add(item_->at, join(item_->path, key) + " is missing" + what);
  return found;
}

const Item* Section::one_of(std::initializer_list<std::string_view> keys) const {
  const Item* first = nullptr;
  for (const std::string_view key : keys) {
    const Item* found = find(key);
    if (first && found)
      found->fail("excludes " + first->path.substr(first->path.rfind('.') + 1) +
                  "; give one of them");
    else if (found)
      first = found;
  }
  return first;
}

std::optional<double> Section::given(std::string_view key, const Range& range) const {
  const Item* item = find(key);
  return item ? read_number(*item, range) : std::nullopt;
}

std::optional<double> Section::required(std::string_view key, const Range& range) const {
  const Item* item = require(key, range.unit.empty() ? "" : fmt::format(" ({})", range.unit));
  return item ? read_number(*item, range) : std::nullopt;
}

int Section::whole(std::string_view key, int fallback) const {
  const Item* item = find(key);
  return item ? read_whole_number(*item, range(key)).value_or(fallback) : fallback;
}

std::string Section::text(std::string_view key) const {
  const Item* item = find(key);
  return item ? read_text(*item).value_or("") : std::string(row(key).word());
}

std::optional<std::size_t> Section::word_index(std::string_view key, std::size_t count,
                                               bool has_default) const {
  const std::vector<std::string_view> words = row(key).words();
  const auto fallback = std::ranges::find(words, row(key).word());
  if (words.size() != count || (has_default && fallback == words.end()))
    throw std::logic_error("the words of " + std::string(key) + " are others");
  const Item* item = find(key);
  if (const auto chosen = item ? read_choice(*item, words) : std::nullopt) return chosen;
  return has_default ? std::optional<std::size_t>(fallback - words.begin()) : std::nullopt;
}

std::optional<Item> peek(const Item& map, std::string_view key) {
  if (!map.node.IsMap()) return std::nullopt;
  // Of a repeated key, which Section reports, the first one counts.
  for (const auto& entry : map.node)
    if (entry.first.IsScalar() && entry.first.Scalar() == key)
      return Item{entry.second, place_of(entry.second), join(map.path, key), map.problems};
  return std::nullopt;
}

std::vector<std::pair<std::string, Item>> entries_of(const Item& map) {
  std::vector<std::pair<std::string, Item>> entries;
  std::set<std::string> names;
  entries.reserve(map.node.size());
  for (const auto& entry : map.node) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const std::string path = join(map.path, name.empty() ? "?" : shown(name));
    if (name.empty())
      map.problems->add(place_of(entry.first), path + " is no name; names are plain words");
    else if (!names.insert(name).second)
      map.problems->add(place_of(entry.first), path + " is repeated");
    else
      entries.emplace_back(name, Item{entry.second, place_of(entry.second), path, map.problems});
  }
  return entries;
}

}  // namespace domefall
