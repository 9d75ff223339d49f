// Four numbers of each of four rays, which stand side by side in memory, as four rays' numbers: quicker
// than gathering them one by one.
#pragma once

#include <cstring>

namespace domefall {

using Quad __attribute__((vector_size(32))) = double;

// at: the rays' numbers; out[n]: where the n-th numbers of all four rays go.
[[gnu::always_inline]] inline void turn_quads(const double* const at[4], double* const out[4]) {
  Quad a, b, c, d;
  std::memcpy(&a, at[0], sizeof a);
  std::memcpy(&b, at[1], sizeof b);
  std::memcpy(&c, at[2], sizeof c);
  std::memcpy(&d, at[3], sizeof d);
  const Quad even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Quad odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Quad odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Quad turned[4] = {__builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5),
                          __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5),
                          __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7),
                          __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7)};
  for (int n = 0; n < 4; ++n) std::memcpy(out[n], &turned[n], sizeof turned[n]);
}

}  // namespace domefall
