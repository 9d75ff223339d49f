#include "pipeline/spacetime/spinning_hole.h"

namespace domefall {

std::vector<double> SpinningHole::parameters() const {
  return {static_cast<double>(kerr.spin),
          static_cast<double>(kerr.charge),
          static_cast<double>(kerr.horizon_distance()),
          axis[0],
          axis[1],
          axis[2]};
}

double SpinningHole::fall_celerity(double r) const {
  const auto a = static_cast<double>(kerr.spin), q = static_cast<double>(kerr.charge);
  const double s = std::sqrt((2 * r - q * q) / (r * r + a * a));
  return -s * (2 + s) / (2 * (1 + s));
}

double SpinningHole::moving_celerity(double r, double radial, double l, bool outgoing) const {
  const double f = lapse_squared(r), energy = std::sqrt(radial * radial + f * (1 + l * l));
  const double u = outgoing ? -radial : radial;
  const double falling = u <= 0 ? energy - u : f * (1 + l * l) / (energy + u);
  const double w = ((1 + l * l) / falling - falling) / 2;
  return outgoing ? -w : w;
}

}  // namespace domefall
