// Numbers that look random, by place: what noise is made of.
#pragma once

#include <cstdint>

namespace domefall {

// This is the finaliser of MurmurHash3 (A. Appleby, public domain), in which each bit of the result
// depends on each bit of x.
[[gnu::always_inline]] inline std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

[[gnu::always_inline]] inline std::uint32_t lattice_key(std::uint32_t a, std::uint32_t b) {
  return mixed(a ^ (b * 0x9e3779b9u + 0x7f4a7c15u));
}

}  // namespace domefall
