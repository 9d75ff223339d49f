// A Section is a map in a show file, checked against the keys that it may have.
#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <utility>

#include "pipeline/show/item.h"

namespace domefall {

class Section {
 public:
  // Makes a section that the show leaves out, so that none of its keys is given.
  Section() = default;
  // Reports an item that is no map, each unknown key with the nearest known one, and repeated keys,
  // which yaml-cpp would accept.
  Section(const Item& item, std::span<const std::string_view> known);
  Section(const Item& item, std::initializer_list<std::string_view> known)
      : Section(item, std::span(known.begin(), known.size())) {}

  // Returns the value of a key, or null if the key is not given.
  const Item* find(std::string_view key) const;
  // Says whether an unknown key was reported for which this one was probably meant.
  bool is_misspelt(std::string_view key) const { return misspelt_.contains(key); }
  // Finds a key in the same way, and reports one that is missing, unless a misspelling of it was
  // reported.
  const Item* require(std::string_view key, const std::string& what) const;
  // Returns the value of the first of the keys that is given, or null.  Reports each further one,
  // since they exclude each other.
  const Item* one_of(std::initializer_list<std::string_view> keys) const;

  // Returns the number under a key, or nothing if the key is not given or its value is wrong.
  std::optional<double> number(std::string_view key, const Range& range) const;
  // Returns the number in the same way, or else the fallback, which has the same unit.
  double number(std::string_view key, const Range& range, double fallback) const;
  std::optional<double> required_number(std::string_view key, const Range& range) const;
  // Returns what the word under a key stands for, or nothing if the key is not given or its word is
  // not known.
  template <class T, std::size_t N>
  std::optional<T> word(std::string_view key,
                        const std::pair<std::string_view, T> (&words)[N]) const {
    const Item* item = find(key);
    const auto table = std::to_array(words);
    const auto chosen = item ? read_choice(*item, names_of(table)) : std::nullopt;
    return chosen ? std::optional(words[*chosen].second) : std::nullopt;
  }

 private:
  void add(const YAML::Node& key, const YAML::Node& value, std::span<const std::string_view> known);

  struct Entry {
    int line;  // of the key
    Item value;
  };
  std::optional<Item> item_;
  std::map<std::string, Entry, std::less<>> entries_;
  std::set<std::string, std::less<>> misspelt_;
};

// Returns the value of a key before it is known which keys the map may have.  Returns nothing if
// there is no such key, or no map.
std::optional<Item> peek(const Item& map, std::string_view key);

// Returns all entries of a map whose keys are names that the user chose, in the order of the file.
// Reports repeated names.
std::vector<std::pair<std::string, Item>> entries_of(const Item& map);

// Returns the section under a key, or an empty one if the key is not given.
Section subsection(const Section& parent, std::string_view key,
                   std::span<const std::string_view> known);
inline Section subsection(const Section& parent, std::string_view key,
                          std::initializer_list<std::string_view> known) {
  return subsection(parent, key, std::span(known.begin(), known.size()));
}

}  // namespace domefall
