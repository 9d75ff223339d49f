// This file says how hot a thin disc is at each radius, after Page & Thorne, ApJ 191, 499 (1974),
// for a hole without spin (M = 1).  Luminet, A&A 75, 228 (1979), prints 1/sqrt 3 for sqrt 3/2
// there.
//
//     F(r) ~ (B(r) + C) / ((r - 3) r^(5/2))                      r >= 6
//     B(r) = sqrt r - sqrt 6 + (sqrt 3/2) ln [(sqrt r + sqrt 3)(sqrt 6 - sqrt 3) /
//                                             ((sqrt r - sqrt 3)(sqrt 6 + sqrt 3))]
//
// C = 0 if nothing pulls at the disc's inner edge, the last stable orbit.  Where gas plunges from
// there, magnetic fields pull with the part d of its angular momentum, and C = sqrt 6 d (Agol &
// Krolik, ApJ 528, 161 (2000), by the same conservation laws).  Here d = 0.02, as simulations of
// thin discs show (Shafee et al., ApJ 687, L25 (2008)).  Without a pull the gas would have cooled
// when it plunges.  On its way it expands and is compressed without losing much of its heat
// (Mummery & Balbus, MNRAS 521, 2439 (2023), for the pressure of radiation),
//
//     F(r) ~ F(6) x^(17/7) [1 + (x - 1)^(3/2)/e]^(-1/7)          2 <= r < 6,  x = 6/r
//
// with e = 0.01, the speed at which it sets out over that of its fall.
#pragma once

namespace domefall {

class PageThorneProfile {
 public:
  explicit PageThorneProfile(bool plunging);

  // Returns the flux from a face of the disc, as the gas measures it, against that of the hottest
  // ring outside the last stable orbit.  r is in units of M.  The flux is 0 below 6, or below 2
  // where gas plunges.  Its relative error is a few epsilon, next to r = 6 too, where it vanishes
  // like (r - 6)^2.
  double flux(double r) const;
  // Returns the temperature likewise, flux^(1/4).
  double temperature(double r) const;

  // Returns the radius of that ring (units of M), which is 9.55, or 6 where gas plunges.
  double hottest() const { return hottest_; }

 private:
  double stable_flux(double r) const;

  bool plunging_;
  double pull_;  // C
  double hottest_ = 0, greatest_ = 1;
};

}  // namespace domefall
