// The boost between the reference tetrad and an observer of any velocity acts on light.  This file
// says where a direction goes, and gives the ratio of frequencies.  [Riazuelo] eq. Lambda_cov,
// nprime_aber, omprime_aber.
//
// Let c = gamma v, let e be the unit direction of c and m the direction in the boosted tetrad, and
// let d = m - e.  Then
//     omega_tetrad/omega_observer = gamma - c.m = 1/(gamma + |c|) + |c| d^2/2
//     n = m_perp / that + e (1 - (1 + beta) gamma (d^2/2) / that),   m_perp = d + e d^2/2
// These keep their digits for any Lorentz factor and direction, where the textbook form cancels.
#pragma once

#include <cmath>

#include "trajectories/directions.h"

namespace domefall {

struct AberratedLight {
  V3d direction;           // unit vector in the other frame
  double frequency_ratio;  // omega there / omega here
};

class Aberration {
 public:
  // The celerity is gamma v of the frame in which directions are given, against the one wanted.
  explicit Aberration(const V3d& celerity)
      : speed_(celerity.length()),
        gamma_(std::sqrt(1 + speed_ * speed_)),
        along_(speed_ > 0 ? celerity / speed_ : V3d(1, 0, 0)) {}

  // Brings light from the moving frame to the frame that the celerity refers to.
  AberratedLight to_rest(const V3d& m) const {
    const V3d d = m - along_;
    const double half_d2 = d.dot(d) / 2;
    const double ratio = 1 / (gamma_ + speed_) + speed_ * half_d2;
    const double inverse = 1 / ratio;
    const double forward = 1 - (gamma_ + speed_) * half_d2 * inverse;
    return {(d + along_ * half_d2) * inverse + along_ * forward, ratio};
  }

 private:
  double speed_, gamma_;
  V3d along_;
};

// Brings light from the reference tetrad to the boosted tetrad of an observer with this celerity.
inline AberratedLight to_observer(const V3d& celerity, const V3d& n) {
  return Aberration(-celerity).to_rest(n);
}

// Brings light from the boosted tetrad to the reference tetrad.
inline AberratedLight to_tetrad(const V3d& celerity, const V3d& m) {
  return Aberration(celerity).to_rest(m);
}

}  // namespace domefall
