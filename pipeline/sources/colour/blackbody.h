// This file gives thermal light as the eye's standard observer and a V-band photometer see it.
#pragma once

#include <array>
#include <vector>

#include "pipeline/sources/colour/colour_space.h"

namespace domefall {

// Returns Planck's spectral radiance, in W/(m^2 sr nm), at a wavelength in nm and a temperature in
// K (> 0).
double planck(double wavelength_nm, double temperature);

// Returns the integral of Planck's law against CIE 1931, whose Y is the luminance in cd/m^2.  It is
// exact and slow.
Xyz blackbody_xyz(double temperature);

// Returns sigma T^4/pi in W/(m^2 sr), by the law of Stefan and Boltzmann.
double blackbody_radiance(double temperature);

// Returns the flux (W/m^2, over all wavelengths) of a blackbody star of V = 0.  It is that of the
// Planck spectrum scaled to 3.631e-11 W/m^2/nm in Bessell's V (PASP 102, 1181, 1990).
double bolometric_flux_at_v_zero(double temperature);

// Beyond this temperature (K) visible light grows with it, by the Rayleigh-Jeans law.
inline constexpr double kRayleighJeans = 1e8;

// BlackbodyColours hold the colour of thermal light by temperature, in a table in ln T.  They take
// one look-up for a pixel or a star whose light was shifted, because a Planck spectrum at T seen at
// frequency ratio g is one at g T.  Measured, they are within 3e-4 of the integral above 700 K.
// Above kRayleighJeans that law continues them.  Below 500 K nothing is visible (under 1e-11 of a
// 5000 K surface) and the colour is black.
class BlackbodyColours {
 public:
  BlackbodyColours();

  // Returns working-space light per unit of bolometric flux, in lm/W.
  WorkingRgb per_flux(double temperature) const;
  // Returns the same of log2(temperature), which is one multiplication from the table.
  WorkingRgb per_flux_log2(float log2_temperature) const;
  // Returns the light of a surface, in cd/m^2.
  WorkingRgb surface(double temperature) const;

 private:
  std::vector<std::array<float, 3>> table_;
};

const BlackbodyColours& blackbody_colours();

}  // namespace domefall
