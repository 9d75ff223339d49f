// Gas that is so thin that light goes through it: a halo about the hole and a pair of jets.  Each is
// where its formula says, turns or flows as its formula says, and glows in proportion to its density
// (docs/disc.md).  Units of M.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "pipeline/sources/colour/colour_space.h"
#include "pipeline/sources/disc/gas_orbits.h"
#include "trajectories/directions.h"

namespace domefall {

// The colour of gas is that of a blackbody of this temperature (K), or grey.
using GasTemperature = std::optional<double>;

// A Halo is a torus of gas about its axis.  With the sine s of the latitude its density is
//
//     n(r, s) = f exp(-(r/R)^2/2 - (s/H)^2/2),      f = Delta/(r^2 + a^2),
//
// and it circles with the angular momentum l = rho^(3/2)/(1 + rho) for each unit of energy, rho =
// r cos(latitude), which is close to a free orbit far away and falls behind it near the hole: the
// analytic model of Gold et al., ApJ 897, 148 (2020), but for f.  On the horizon nothing circles, and
// without f its light would be bright beyond bounds for who falls past.
struct Halo {
  SkyDirection normal{V3d(0, 0, 1)};
  double r = 10, height = 0.3;  // R, H
  double luminance = 1e-3;      // of R of the densest gas, for whoever moves with it, cd/m^2
  GasTemperature temperature{};

  bool operator==(const Halo& o) const {
    return normal.v == o.normal.v && r == o.r && height == o.height && luminance == o.luminance &&
           temperature == o.temperature;
  }
};

// A Jet is a pair of cones of gas that flows away from the hole along its axis and against it, with
// one Lorentz factor against whoever is there without angular momentum.  With the angle a from the axis
// its density is
//
//     n(r, a) = (R/r)^2 exp(-(a/A)^2/2) x^2 (3 - 2x) exp(-(r/D)^2/2),   x = (r - r_+)/R, at most 1,
//
// as nothing is lost on the way and it fades at the distance D.
struct Jet {
  SkyDirection normal{V3d(0, 0, 1)};
  double lorentz = 3, opening = 0.1;  // radians, A
  double r = 6, length = 100;         // R, D
  double luminance = 1e-3;            // of R of gas on the axis at R, for whoever moves with it
  GasTemperature temperature{};

  bool operator==(const Jet& o) const {
    return normal.v == o.normal.v && lorentz == o.lorentz && opening == o.opening && r == o.r &&
           length == o.length && luminance == o.luminance && temperature == o.temperature;
  }
};

// A GasPlace is a place on a ray: r, the sine of the latitude about the axis, and what decides the
// shift there, by GasRay.
struct GasPlace {
  double r, latitude_sine;
  double rising;  // dr by Mino's time of the light that sets out
};

// Returns how dense gas is at a place, 1 at most.
double density(const Halo& halo, const GasOrbits& hole, const GasPlace& at);
double density(const Jet& jet, const GasOrbits& hole, const GasPlace& at);
// Returns the frequency that gas sends at a place outside the horizon, over that in the reference
// tetrad.
double sent_frequency(const Halo& halo, const GasOrbits& hole, const GasRay& ray,
                      const GasPlace& at);
double sent_frequency(const Jet& jet, const GasOrbits& hole, const GasRay& ray, const GasPlace& at);
// Returns a radius beyond which there is no gas to speak of.
double reach(const Halo& halo);
double reach(const Jet& jet);
// Returns the longest step in the angle that a ray sweeps about the hole (radians) with which gas is
// summed up next to a latitude, with its sine without its sign.  It is infinite where no gas is within
// `length` radians.
double longest_step(const Halo& halo, double latitude_sine, double length);
double longest_step(const Jet& jet, double latitude_sine, double length);

// A GasColour is the light of one M of gas of density 1, in cd/m^2, by the ratio g of the frequency
// seen and that sent.  A blackbody's is its surface's at g T; grey gas has a flat spectrum, whose
// light goes with g^3.
class GasColour {
 public:
  // `luminance` is that of `across` M of the gas, without a shift.  `coloured` and `dimmed` say whether
  // the shift changes the colour, and the light.
  GasColour(const GasTemperature& temperature, double luminance, double across, bool coloured,
            bool dimmed);

  WorkingRgb light(double g) const;

 private:
  std::vector<std::array<float, 3>> table_;  // at even steps of ln g
};

}  // namespace domefall
