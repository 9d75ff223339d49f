// Thermal light as the eye's standard observer and a V-band photometer see it.
#pragma once

#include <array>
#include <vector>

#include "pipeline/colour/colour_space.h"

namespace domefall {

// Planck's spectral radiance, W/(m^2 sr nm), at a wavelength in nm and a temperature in K (> 0).
double planck(double wavelength_nm, double temperature);

// Integral of Planck's law against CIE 1931: luminance Y in cd/m^2.  Exact, slow.
Xyz blackbody_xyz(double temperature);

// Stefan-Boltzmann: sigma T^4/pi, W/(m^2 sr).
double blackbody_radiance(double temperature);

// Flux (W/m^2, over all wavelengths) of a blackbody star of V = 0: the Planck spectrum scaled to
// 3.631e-11 W/m^2/nm in Bessell's V (PASP 102, 1181, 1990).
double bolometric_flux_at_v_zero(double temperature);

// Beyond this temperature (K) visible light grows with it, by the Rayleigh-Jeans law.
inline constexpr double kRayleighJeans = 1e8;

// The colour of thermal light by temperature, tabulated in ln T: one look-up for a pixel or a star
// whose light was shifted, since a Planck spectrum at T seen at frequency ratio g is one at g T.
// Measured: within 3e-4 of the integral above 700 K.  Above kRayleighJeans that law continues
// it; below 500 K nothing is visible (under 1e-11 of a 5000 K surface) and it is black.
class BlackbodyColours {
 public:
  BlackbodyColours();

  // Working-space light per unit of bolometric flux: lm/W.
  WorkingRgb per_flux(double temperature) const;
  // The same of log2(temperature): one multiplication from the table.
  WorkingRgb per_flux_log2(float log2_temperature) const;
  // Of a surface: cd/m^2.
  WorkingRgb surface(double temperature) const;

 private:
  std::vector<std::array<float, 3>> table_;
};

const BlackbodyColours& blackbody_colours();

}  // namespace domefall
