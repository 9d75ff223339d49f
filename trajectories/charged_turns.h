// The turning points of free fall near a charge.  With w = 1/r
//
//   (dr/dtau)^2 = P(w) = (E^2 - 1) + 2w - (q^2 + L^2) w^2 + 2 L^2 w^3 - q^2 L^2 w^4
//
// An orbit moves between two neighbouring roots of P, w1 = 1/far and w2 = 1/near.  The rest,
// Q = P/((w - w1)(w2 - w)), is held as a sum of terms that are not negative.  How long an orbit whirls
// is decided by its smallest term, the gap between two roots, which therefore has all its digits.
#pragma once

#include "pipeline/spacetime/charged.h"

namespace domefall {

struct ChargedTurns {
  // The other two roots are inside the periastron, beyond the apoastron, or complex.
  enum class Others { kInside, kBeyond, kComplex };

  ChargedHole hole;
  double energy, l;  // E >= 0, L >= 0 (M)
  double near, far;  // M; far is infinite for what is not bound
  double width;      // far - near
  double w1;         // 1/far, or the root that is not positive
  Others others;
  double a;  // q^2 L^2
  // Q is (gap + w2 - w)(lead + a (w2 - w)), (gap + w - w1)(lead + a (w - w1)), or
  // lead + a (w - middle)^2.
  double gap, lead, middle;

  bool is_bound() const { return w1 > 0; }
  // Returns Q where w2 - w = below and w - w1 = above, and for complex roots w - middle = off.
  double rest(double below, double above, double off) const {
    if (others == Others::kComplex) return lead + a * off * off;
    const double apart = others == Others::kInside ? below : above;
    return (gap + apart) * (lead + a * apart);
  }
};

}  // namespace domefall
