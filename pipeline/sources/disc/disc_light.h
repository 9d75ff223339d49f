// The light of a disc: its temperature by Page and Thorne, its colour and radiance, and its shift on
// the way to an observer.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pipeline/light/null_ray.h"
#include "pipeline/sources/colour/colour_space.h"
#include "pipeline/sources/disc/disc_pattern.h"
#include "trajectories/directions.h"

namespace domefall {

// A PageThorneProfile says how hot a thin disc is at each radius, after Page & Thorne, ApJ 191, 499
// (1974) (M = 1).  With E, L and Omega of circular orbits, outside the last one that is stable, r_s,
//
//     F(r) ~ -Omega' (B(r) + C)/(r (E - Omega L)^2),   B = int (E - Omega L) dL.
//
// About a spin this is a quadrature, with dL/dr = -R''/(Omega dR'/dE + dR'/dL) of the radial potential
// R of kerr.h's orbits.  Without one, about a charge q, with y = sqrt(r - q^2), A = r_c - q^2 and D =
// q^2 (1 - 2/r_c), r_c the circle of light, the integral is elementary:
//
//     dB/dy = 1 - 2 q^2/(y^2 + q^2) + D/(y^2 + D) - A/(y^2 - A).
//
// Without one it is Page and Thorne's sqrt r - sqrt 6 + (sqrt 3/2) ln[...].  (Luminet, A&A 75, 228
// (1979), prints 1/sqrt 3 for sqrt 3/2.)
//
// C = 0 if nothing pulls at the disc's inner edge, the last stable orbit.  Where gas plunges from
// there, magnetic fields pull with the part d of its angular momentum, and C = d L (E - Omega L)
// there (Agol & Krolik, ApJ 528, 161 (2000), by the same conservation laws).  Here d = 0.02, as
// simulations of thin discs show (Shafee et al., ApJ 687, L25 (2008)).  Without a pull the gas would
// have cooled when it plunges.  On its way it expands and is compressed without losing much of its
// heat (Mummery & Balbus, MNRAS 521, 2439 (2023), for the pressure of radiation),
//
//     F(r) ~ F(r_s) (r_s/r)^(17/7) [1 + u/e]^(-1/7)          r_+ <= r < r_s
//
// with u the speed of the fall by GasOrbits::fall, (6/r - 1)^(3/2) without charge and spin, and e = 0.01
// that with which it sets out.
class PageThorneProfile {
 public:
  explicit PageThorneProfile(bool plunging, const GasOrbits& orbits = GasOrbits());

  // Returns the flux from a face of the disc, as the gas measures it, against that of the hottest
  // ring outside the last stable orbit.  r is in units of M.  The flux is 0 below that orbit, or
  // below the horizon where gas plunges.  Its relative error is a few epsilon, next to r_s too,
  // where it vanishes like (r - r_s)^2.
  double flux(double r) const;
  // Returns the temperature likewise, flux^(1/4).
  double temperature(double r) const;

  // Returns the radius of that ring (units of M), which is 9.55 without a charge, or r_s where gas
  // plunges.
  double hottest() const { return hottest_; }
  // Returns that ring's flux, in a unit by which discs of one rate of infall have one flux far from all
  // holes of one mass.
  double greatest() const { return greatest_; }

 private:
  double brought(double r) const;  // B
  double stable_flux(double r) const;
  double brought_by_quadrature(double r) const;

  GasOrbits orbits_;
  bool plunging_;
  double a_, d_;  // A, D
  double pull_;   // C
  double hottest_ = 0, greatest_ = 1;
};

// A DiscLight is the light of a disc's surface.  The surface is a blackbody of the profile's
// temperature T(r).  An observer sees one of g T, in colour and radiance, where g is the frequency
// observed over the one sent.  The light is scaled so that the hottest ring has the show's
// luminance for whoever moves with it.
class DiscLight {
 public:
  // Throws as DiscPattern.
  explicit DiscLight(const Disc& disc);

  const Disc& disc() const { return disc_; }
  // The pattern of its gas, or null.
  const DiscPattern* pattern() const { return pattern_ ? &*pattern_ : nullptr; }

  // Returns the temperature in the gas's own frame (K).  It is 0 where there is no gas of the
  // profile, whatever the disc's radii are.
  double temperature(double r) const;
  // Returns the light of an opaque disc, in cd/m^2 in the working space, for r in units of M and
  // g >= 0.  It is black where there is no gas, and at most some 1e37.
  WorkingRgb light(double r, double g) const;

  // Returns the same of many places with as many ratios, for pixels.  r > 0 and g >= 0 are finite.
  // Measured against light(), the relative error is below 6e-5.  Next to the last stable orbit,
  // where gas plunges, it is below 2.5e-4, half the largest rounding error of a half float.
  void light(std::span<const float> r, std::span<const float> g, std::span<WorkingRgb> out) const;

 private:
  Disc disc_;
  PageThorneProfile profile_;
  std::optional<DiscPattern> pattern_;
  double scale_;  // from a blackbody's luminance to the show's
  // This is log2 T without what is singular in it, at even steps of sqrt(r_s/r).
  std::vector<float> table_;
};

// Returns the optical depth through the disc at right angles, at a radius between its own.  Gas that falls
// in is drawn down to the horizon.  For whoever is inside it thins out towards there, over more of its
// radius the farther in the observer's r, `seen_from`, is, and no more than the disc's rim.
double depth_across(const Disc& disc, double r, double seen_from);
// Returns the part of the light along a ray that gas at r absorbs and replaces by its own.  The ray
// leaves the disc at an angle whose cosine is `steepness` for the gas, 0 to 1, so that the optical
// depth along it is the disc's over that cosine.
double absorbed_part(const Disc& disc, double r, double seen_from, double steepness);

// The shift of a disc's light on its way to an observer follows from a GasRay, which holds what
// decides it of a view ray.  Gas on a circular orbit has u^t and turns with Omega (gas_orbits.h)
// about the disc's axis n.  It sends light of the ray with E, L_n at (M = 1)
//
//     1 + z = u^t (E - Omega L_n) / (k.u),      L_n = -L (r^ x e^).n
//
// times the frequency that the observer measures, k.u.  Here r^ is the observer's place and e^ the
// tangent in which the ray sweeps its angle, followed back in time.  In the reference tetrad k.u =
// 1.  For whoever moves against it the result is multiplied by the frequency there over the one
// observed, AberratedLight::frequency_ratio of to_tetrad().  Gas that plunges with E', L' and u^r
// sends, with P = (r^2 + a^2) E - a L_n, Y = L_n - a E and s^2 = P^2 - Delta K, likewise P', Y', s',
//
//     1 + z = [(P P' +- s s')/Delta - Y Y']/r^2 / (k.u),
//
// where light moves outwards (+) or inwards.
//
// The place, the tangent and the normal are r^, e^ and n, unit vectors of one frame.  It may be the
// tetrad's (R, Theta, Phi) or the celestial sphere's.
GasRay disc_ray(const RayInvariants& ray, const V3d& place, const V3d& tangent, const V3d& normal);

// Returns the frequency that gas at r sends over the one that the reference tetrad sees at the
// observer's place, for r above the horizon (units of M) in region I.  The gas plunges below the
// last stable orbit.  `outward` says whether the light sets out to larger radii, which matters to
// plunging gas alone.  The result is infinite where light sets out outward from the horizon.
double disc_shift(const GasOrbits& orbits, const GasRay& ray, double r, bool outward);

}  // namespace domefall
