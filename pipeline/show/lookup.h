// What a show names: files and stars.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/show/item.h"
#include "pipeline/sky/catalogue/star_catalogue.h"

namespace domefall {

class Lookup {
 public:
  // `folder` of the show file; empty if it was named without one.
  explicit Lookup(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // A regular, readable file, sought beside the show and then as the process finds it.
  std::optional<std::filesystem::path> find(const std::string& name) const;
  // The same, reporting what is not there.
  std::optional<std::filesystem::path> file(const Item& item, const std::string& name) const;
  // One of the files that come with Domefall; `item` is what asked for it.
  std::optional<std::filesystem::path> shipped(const Item& item, std::string_view name) const;

  // A star of the shipped naked-eye catalogue, which is read when the first one is named.  `words`
  // are what else could have been meant.
  std::optional<SkyDirection> star(const Item& item, std::span<const std::string_view> words = {});

 private:
  std::filesystem::path folder_;
  std::optional<StarCatalogue> stars_;
};

// A star's name, {star: NAME} or {ra_deg: , dec_deg: }, J2000.
std::optional<SkyDirection> read_sky_place(const Item& item, Lookup& lookup,
                                           std::span<const std::string_view> words = {});

inline constexpr double radians(double degrees) { return degrees * 0.017453292519943295; }

}  // namespace domefall
