#include "pipeline/sources/disc/gas_orbits.h"

namespace domefall {

GasOrbits::GasOrbits(const ChargedHole& hole)
    : square_(hole.charge * hole.charge),
      horizon_(hole.horizon()),
      last_stable_(hole.last_stable_orbit()) {
  const double r = last_stable_, delta = r * (r - 2) + square_;
  const double slowing = r * (r - 3) + 2 * square_, above = r - square_;
  const double energy2 = delta * delta / (r * r * slowing);
  const double momentum2 = r * r * above / slowing;
  energy_ = std::sqrt(energy2);
  momentum_ = std::sqrt(momentum2);
  turning_ = std::sqrt(momentum2 / energy2);
  slowness_ = std::sqrt(r * slowing / (2 * above) / (1 - 2 * square_ / r));
}

}  // namespace domefall
