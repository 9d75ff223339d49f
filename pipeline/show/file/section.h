// A Section is a map in a show file, checked against the keys that it may have.
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>

#include "pipeline/show/file/keys.h"

namespace domefall {

class Section {
 public:
  // Takes the keys of these tables (keys.cpp), the first of two of one name.  An item of null is a
  // section that the show leaves out, so that none of its keys is given.  Reports an item that is no
  // map, each unknown key with the nearest known one, and repeated keys, which yaml-cpp would accept.
  Section(const Item* item, std::initializer_list<std::string_view> tables);
  Section(const Item& item, std::initializer_list<std::string_view> tables)
      : Section(&item, tables) {}

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

  Range range(std::string_view key) const { return row(key).range(); }

  // Returns the number under a key, or nothing if the key is not given or its value is wrong.
  std::optional<double> given(std::string_view key) const { return given(key, range(key)); }
  std::optional<double> given(std::string_view key, const Range& range) const;
  std::optional<double> required(std::string_view key) const { return required(key, range(key)); }
  std::optional<double> required(std::string_view key, const Range& range) const;
  // These return the default in that case.
  double number(std::string_view key) const { return number(key, row(key).number()); }
  double number(std::string_view key, double fallback) const {
    return given(key).value_or(fallback);
  }
  double angle(std::string_view key) const { return radians(number(key)); }  // from degrees
  int whole(std::string_view key) const { return whole(key, static_cast<int>(row(key).number())); }
  int whole(std::string_view key, int fallback) const;
  std::string text(std::string_view key) const;
  bool flag(std::string_view key) const { return word(key, {true, false}); }
  // Returns which of the `meanings` the word under a key has.  They stand in the order of its words.
  template <class T>
  T word(std::string_view key, std::initializer_list<T> meanings) const {
    return meanings.begin()[*word_index(key, meanings.size(), true)];
  }
  template <class T, std::size_t N>
  T word(std::string_view key, const std::array<T, N>& meanings) const {
    return meanings[*word_index(key, N, true)];
  }
  template <class T>
  std::optional<T> given_word(std::string_view key, std::initializer_list<T> meanings) const {
    const auto index = word_index(key, meanings.size(), false);
    return index ? std::optional(meanings.begin()[*index]) : std::nullopt;
  }

 private:
  const Key& row(std::string_view key) const;
  void add(const YAML::Node& key, const YAML::Node& value);
  std::vector<std::string_view> known() const;
  std::optional<std::size_t> word_index(std::string_view key, std::size_t count,
                                        bool has_default) const;

  struct Entry {
    int line;  // of the key
    Item value;
  };
  std::vector<Key> keys_;
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

// Returns what the map `known` has under the name that an item is.  Returns null for a name that is
// not known, which is reported.  `missing` begins the message.
template <class Known>
const typename Known::mapped_type* find_named(const Item& name, const Known& known,
                                              const std::string& missing) {
  const auto text = read_text(name);
  if (!text) return nullptr;
  const auto found = known.find(*text);
  if (found != known.end()) return &found->second;
  std::vector<std::string_view> names;
  names.reserve(known.size());
  for (const auto& [other, meaning] : known) names.push_back(other);
  name.fail(missing + ": '" + shown(*text) + "'" + did_you_mean(*text, names));
  return nullptr;
}

}  // namespace domefall
