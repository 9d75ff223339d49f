#include "pipeline/show/section.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

// Returns the place of a node, whose line and column yaml-cpp counts from 0 as TextPlace does.
TextPlace place_of(const YAML::Node& node) { return {node.Mark().line, node.Mark().column}; }

// Returns the path of a key below another path, which is empty for the whole show.
std::string join(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

}  // namespace

Section::Section(const Item& item, std::span<const std::string_view> known) {
  // The item is emplaced, since its node is const and it cannot be assigned.
  item_.emplace(item);
  if (!item.node.IsMap()) {
    item.fail(std::string("must be a map of keys (") + listed(known) + "), got " + kind_of(item));
    // A section without an item finds no keys, and reports none as missing.
    item_.reset();
    return;
  }
  for (const auto& entry : item.node) add(entry.first, entry.second, known);
}

// Enters one key with its value, or reports why it has no place in this section.
void Section::add(const YAML::Node& key, const YAML::Node& value,
                  std::span<const std::string_view> known) {
  Problems& problems = *item_->problems;
  if (!key.IsScalar()) {
    // YAML allows a map or a list as a key, which has no name that a path could show.
    problems.add(place_of(key), join(item_->path, "?") + " is no key; keys are plain words");
    return;
  }
  const std::string& name = key.Scalar();
  const std::string path = join(item_->path, shown(name));
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    const std::string_view nearest = nearest_word(name, known);
    // The key that was probably meant must not be reported as missing too.
    misspelt_.insert(std::string(nearest));
    problems.add(place_of(key),
                 path + " is an unknown key; " +
                     (nearest.empty() ? "known here: " + listed(known)
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
  // The first key in the order of `keys`, which need not be that of the file, is kept, and the
  // others are blamed.
  const Item* first = nullptr;
  for (const std::string_view key : keys) {
    const Item* found = find(key);
    if (first && found)
      // Both keys are in this section, so the last part of the path is enough to name the other
      // one.
      found->fail("excludes " + first->path.substr(first->path.rfind('.') + 1) +
                  "; give one of them");
    else if (found)
      first = found;
  }
  return first;
}

std::optional<double> Section::number(std::string_view key, const Range& range) const {
  const Item* item = find(key);
  return item ? read_number(*item, range) : std::nullopt;
}

double Section::number(std::string_view key, const Range& range, double fallback) const {
  return number(key, range).value_or(fallback);
}

std::optional<double> Section::required_number(std::string_view key, const Range& range) const {
  const Item* item = require(key, range.unit.empty() ? "" : fmt::format(" ({})", range.unit));
  return item ? read_number(*item, range) : std::nullopt;
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
    // A map or a list in the place of a name has no text, and is reported like an empty name.
    if (name.empty())
      map.problems->add(place_of(entry.first), path + " is no name; names are plain words");
    else if (!names.insert(name).second)
      map.problems->add(place_of(entry.first), path + " is repeated");
    else
      entries.emplace_back(name, Item{entry.second, place_of(entry.second), path, map.problems});
  }
  return entries;
}

Section subsection(const Section& parent, std::string_view key,
                   std::span<const std::string_view> known) {
  const Item* item = parent.find(key);
  // An item that is no map is reported by the constructor, and its section then finds no keys.
  return item ? Section(*item, known) : Section();
}

}  // namespace domefall
