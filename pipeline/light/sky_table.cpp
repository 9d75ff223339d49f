#include "pipeline/light/sky_table.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

namespace domefall {
namespace {

// The law takes over here, in units of the smallest angle of the scene.
constexpr double kInnermost = 1e-7;

}  // namespace

EdgeLaw fit_edge_law(double x_min, double n, const std::function<double(double)>& phi) {
  // Here g = phi + n ln z = c + z (a + b ln z) at z = 1, 1/4, 1/16.
  const double l = std::log(4.0);
  const double g1 = phi(x_min), g2 = phi(x_min / 4) - n * l, g3 = phi(x_min / 16) - 2 * n * l;
  EdgeLaw law{x_min, n, 0, 0, 0};
  law.a = 8 * (g1 + g2 - 2 * g3) / 9;
  law.b = 4 * (g1 - g2 - 0.75 * law.a) / l;
  law.c = g1 - law.a;
  return law;
}

double EdgeLaw::distance(double phi) const {
  // In z = exp((c - phi + z (a + b ln z))/n) the last term is below 1e-5, so a few rounds settle it.
  double z = std::exp((c - phi) / n);
  for (int k = 0; k < 8 && z > 0; ++k) z = std::exp((c - phi + z * (a + b * std::log(z))) / n);
  return z * x_min;
}

SkyTable::SkyTable(const SkyZone& zone, int bits)
    : zone_(zone),
      x_max_(2 * std::tan(zone.reach / 4)),
      curve_(
          std::min(kInnermost * zone.least, x_max_ / 4), x_max_,
          [this](double x) { return continued_azimuth(x); }, zone.uneven ? bits + 1 : bits) {
  law_ = fit_edge_law(curve_.x_min(), zone.logarithm, [this](double x) {
    return zone_.winding ? continued_azimuth(x) - winding(x) : continued_azimuth(x);
  });
}

ZoneRay SkyTable::ray_at_distance(double x) const {
  return zone_.ray(std::min(4 * std::atan(x / 2), zone_.reach));
}

// Returns phi continued oddly through the end of the sky (alpha = pi or 0), so that the last
// interval may reach beyond it.
double SkyTable::continued_azimuth(double x) const {
  const double offset = 4 * std::atan(x / 2);
  return offset <= zone_.reach ? zone_.azimuth(offset) : -zone_.azimuth(2 * zone_.reach - offset);
}

double SkyTable::slope(double x) const {
  constexpr double kStep = 1e-4;  // of x, for a central difference
  double by_x = 0;
  if (x >= curve_.x_min())
    by_x = curve_.at(x).first;
  else if (zone_.winding)
    by_x = law_.slope(x) + (winding(x * (1 + kStep)) - winding(x * (1 - kStep))) / (2 * kStep * x);
  else
    by_x = law_.slope(x);
  return std::abs(by_x) * (1 + x * x / 4) / 2;
}

// Solves in the logarithm of x, against which that of the azimuth is nearly straight.
double SkyTable::distance_beside_edge(double phi) const {
  if (!zone_.winding) return law_.distance(phi);
  constexpr double kLeast = -690;  // of ln x; a double has hardly any less
  const auto excess = [&](double log_x) { return std::log(beside_edge(std::exp(log_x)) / phi); };
  const double high = std::log(curve_.x_min());
  if (!(excess(kLeast) > 0)) return std::exp(kLeast);
  std::uintmax_t steps = 60;
  const auto [low, up] = boost::math::tools::toms748_solve(
      excess, kLeast, high, boost::math::tools::eps_tolerance<double>(50), steps);
  return std::exp((low + up) / 2);
}

double SkyTable::distance(double phi) const {
  if (phi <= 0) return x_max_;
  if (phi > beside_edge(curve_.x_min())) return distance_beside_edge(phi);
  return std::min(curve_.inverse(phi, x_max_), x_max_);
}

}  // namespace domefall
