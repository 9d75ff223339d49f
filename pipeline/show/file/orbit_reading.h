// What the readers of orbits near holes with and without a charge share.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pipeline/show/file/section.h"

namespace domefall {

// Returns a section with the keys of one type and those of every orbit.
inline Section orbit_section(const Item& item, std::string_view type) {
  return {item, {"trajectory", "region", "begin", type, "end", "rates", "pace"}};
}

// Reports that an orbit does not exist.  Trajectories begin their messages with the name of the
// quantity that is out of bounds.  If the show gives that quantity, its key is blamed, and else the
// key `asked`.
void fail_impossible(const Section& s, const Item& asked, const std::string& message);

// Returns what make() returns, or reports the error that it throws if the orbit does not exist.
template <class Make>
auto made(const Section& s, const Item& asked, const Make& make)
    -> std::optional<decltype(make())> {
  try {
    return make();
  } catch (const std::domain_error& error) {
    fail_impossible(s, asked, error.what());
    return std::nullopt;
  }
}

}  // namespace domefall
