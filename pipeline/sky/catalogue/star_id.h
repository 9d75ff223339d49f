// A star identifier is the star's number in the catalogue that named it, in 32 bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace domefall {

// The two upper bits say which catalogue it is: none, Hipparcos, Henry Draper or Tycho.  The lower
// ones are the star's number in it.
using StarId = std::uint32_t;

inline constexpr StarId kNoStarId = 0;

// The numbers of Hipparcos end here, and so do those of the Henry Draper Catalogue with its
// Extension.
inline constexpr double kLastHip = 120416, kLastHd = 359083;

// These functions make an identifier from a number of 1 to 2^30 - 1.
StarId hipparcos_id(std::uint32_t number);
StarId henry_draper_id(std::uint32_t number);
// By the ReadMe of I/259 (Hog et al. 2000), regions are 1 to 9537, numbers 1 to 12121 and
// components 1 to 4.
StarId tycho_id(std::uint32_t region, std::uint32_t number, std::uint32_t component);

// Returns "HIP 32349", "HD 48915" or "TYC 5949-2777-1", or an empty text for kNoStarId.
std::string star_id_name(StarId id);
// Returns the identifier of such a name, in any case and with any blanks.  Returns nothing for
// other text and for numbers out of range.
std::optional<StarId> parse_star_id(std::string_view text);

}  // namespace domefall
