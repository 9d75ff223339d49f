// These functions turn rows of numbers into columns.  The rows may lie anywhere in memory, such as
// the coefficients of the polynomials for many rays.  Loading whole rows and transposing them in
// registers is quicker than gathering their numbers one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

namespace domefall {

using Quad __attribute__((vector_size(32))) = double;

// Transposes four rows of four numbers: the n-th number of row m goes to columns[n][m].
[[gnu::always_inline]] inline void transpose_quads(const double* const rows[4],
                                                   double* const columns[4]) {
  Quad a, b, c, d;
  std::memcpy(&a, rows[0], sizeof a);
  std::memcpy(&b, rows[1], sizeof b);
  std::memcpy(&c, rows[2], sizeof c);
  std::memcpy(&d, rows[3], sizeof d);
  const Quad even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Quad odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Quad odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Quad transposed[4] = {__builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5),
                              __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5),
                              __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7),
                              __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7)};
  for (int n = 0; n < 4; ++n) std::memcpy(columns[n], &transposed[n], sizeof transposed[n]);
}

// Turns `count` rows of kTerms numbers each into columns: columns[n][k] = rows[k][n].  `count` and
// kTerms must be multiples of four.
template <std::size_t kTerms, std::size_t kSize>
[[gnu::always_inline]] inline void transpose_rows(
    const std::array<const double*, kSize>& rows, int count,
    std::array<std::array<double, kSize>, kTerms>& columns) {
  static_assert(kTerms % 4 == 0 && kSize % 4 == 0);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); k += 4)
    for (std::size_t first = 0; first < kTerms; first += 4) {
      const double* from[4];
      double* to[4];
      for (std::size_t m = 0; m < 4; ++m) {
        from[m] = rows[k + m] + first;
        to[m] = &columns[first + m][k];
      }
      transpose_quads(from, to);
    }
}

}  // namespace domefall
