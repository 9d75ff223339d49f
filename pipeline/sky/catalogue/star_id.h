// A star's number in the catalogue that named it, in 32 bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace domefall {

// The two upper bits say which catalogue: none, Hipparcos, Henry Draper, Tycho; the rest is the number.
using StarId = std::uint32_t;

inline constexpr StarId kNoStarId = 0;

// The number: 1 to 2^30 - 1.
StarId hipparcos_id(std::uint32_t number);
StarId henry_draper_id(std::uint32_t number);
// [Hog et al. 2000, ReadMe of I/259]: regions 1 to 9537, numbers 1 to 12121, components 1 to 4.
StarId tycho_id(std::uint32_t region, std::uint32_t number, std::uint32_t component);

// "HIP 32349", "HD 48915", "TYC 5949-2777-1"; empty for none.
std::string star_id_name(StarId id);
// The same back, whatever the case and the blanks; nothing for other text and numbers out of range.
std::optional<StarId> parse_star_id(std::string_view text);

}  // namespace domefall
