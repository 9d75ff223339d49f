// The angular part of a ray near a spinning hole: its place is N turned by psi about the hole's axis,
// where the unit vector N obeys, over Mino's time with E = 1,
//
//     N'' = -(C + 2 a^2 N_z^2) N + a^2 N_z z
//
// which has no axis.  N is followed by its Taylor series.
#pragma once

#include <array>
#include <vector>

#include "pipeline/light/dual.h"
#include "pipeline/light/kerr_start.h"

namespace domefall {

template <class T>
struct KerrSphere {
  double spin;
  T c;                            // C
  T half_turn;                    // of N_z, in Mino time; 0 where it keeps its sign
  std::array<T, 3> place, speed;  // N and N'

  // How often N_z was extreme, and where N crossed the equator.
  struct Crossing {
    double mino;
    std::array<double, 3> place;
    double squares;  // the integral of N_z^2 until then
  };

  int turns = 0;
  std::vector<Crossing> crossings;
  double squares = 0;

  // Follows N over a Mino time.
  void follow(const T& mino);
  // Likewise, with its crossings, all the way.  This is exact for the value only.
  void follow(double mino, bool with_crossings);
};

// Returns N and its equation at the observer, back in time.
template <class T>
KerrSphere<T> kerr_sphere_of(const KerrStart& start);

extern template struct KerrSphere<double>;
extern template struct KerrSphere<Dual>;

}  // namespace domefall
