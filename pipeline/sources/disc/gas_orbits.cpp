#include "pipeline/sources/disc/gas_orbits.h"

namespace domefall {

GasOrbits::GasOrbits(const ChargedHole& hole)
    : square_(hole.charge * hole.charge),
      horizon_(hole.horizon()),
      last_stable_(hole.last_stable_orbit()) {
  set_plunge();
}

GasOrbits::GasOrbits(const KerrHole& hole, bool retrograde)
    : spin_(static_cast<double>(retrograde ? -hole.spin : hole.spin)),
      square_(static_cast<double>(hole.charge * hole.charge)),
      horizon_(static_cast<double>(hole.horizon())),
      last_stable_(last_stable_circle(hole, !retrograde)) {
  set_plunge();
}

void GasOrbits::set_plunge() {
  const double r = last_stable_, w = std::sqrt(r - square_), a = spin_;
  const double n = r * std::sqrt(r * (r - 3) + 2 * square_ + 2 * a * w);
  energy_ = (r * (r - 2) + square_ + a * w) / n;
  momentum_ = (w * (r * r + a * a) - a * (2 * r - square_)) / n;
  const double bound = (1 - energy_) * (1 + energy_), y = momentum_ - a * energy_;
  root_ = square_ * y * y / (bound * r * r * r);
  slowness_ = 1 / std::sqrt(bound * (1 - root_ / r));
}

}  // namespace domefall
