#include "pipeline/light/sky_table.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

namespace domefall {
namespace {

// The laws take over here, in units of the smallest angle of the scene.
constexpr double kInnermost = 1e-7;
// Below these the leading terms are within 1e-11 of the azimuth.
constexpr double kInnermostLevel = 1e-5, kInnermostLine = 1e-5, kInnermostCore = 1e-12;

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
      x_split_(zone.end ? 2 * std::tan(zone.reach / 8) : HUGE_VAL),
      curve_(
          std::min((zone.level ? kInnermostLevel : kInnermost) * zone.least, x_max_ / 4),
          std::min(x_max_, x_split_), [this](double x) { return continued_azimuth(x); },
          zone.uneven ? bits + 1 : bits) {
  const double x_min = curve_.x_min();
  if (zone.level)
    level_ = PowerLaw{x_min, zone.azimuth(0), curve_.value(x_min) - zone.azimuth(0), 2};
  else if (zone.logarithm > 0)
    law_ = fit_edge_law(x_min, zone.logarithm, [this](double x) {
      return zone_.winding ? continued_azimuth(x) - winding(x) : continued_azimuth(x);
    });
  if (!zone.end) return;
  const double y_min = (zone.end->core ? kInnermostCore : kInnermostLine) * zone.end->least;
  end_curve_.emplace(
      std::min(y_min, x_split_ / 4), x_split_,
      [this](double y) { return zone_.end->azimuth(4 * std::atan(y / 2)); },
      zone.uneven ? bits + 1 : bits);
  end_law_ = PowerLaw{end_curve_->x_min(), 0, end_curve_->value(end_curve_->x_min()),
                      zone.end->core ? 0.5 : 1};
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

double SkyTable::beside_edge(double x) const {
  if (level_) return level_->azimuth(x);
  if (!law_) return continued_azimuth(x);
  return zone_.winding ? law_->azimuth(x) + winding(x) : law_->azimuth(x);
}

double SkyTable::slope_by_x(double x) const {
  constexpr double kStep = 1e-4;  // of x, for a central difference
  if (x >= curve_.x_min()) return curve_.at(x).first;
  if (level_) return level_->slope(x);
  if (law_ && !zone_.winding) return law_->slope(x);
  return (beside_edge(x * (1 + kStep)) - beside_edge(x * (1 - kStep))) / (2 * kStep * x);
}

double SkyTable::slope(double x) const {
  if (x > x_split_) return slope_at_end(from_end(x));
  return std::abs(slope_by_x(x)) * (1 + x * x / 4) / 2;
}

double SkyTable::curvature() const {
  return level_ ? std::abs(level_->rise) / (2 * level_->x_min * level_->x_min) : 0;
}

double SkyTable::end_azimuth(double y) const {
  return y < end_law_->x_min ? end_law_->azimuth(std::max(0.0, y)) : end_curve_->value(y);
}

double SkyTable::slope_at_end(double y) const {
  const double by_y = end_curve_->at(std::max(y, end_curve_->x_min())).first;
  return std::abs(by_y) * (1 + y * y / 4) / 2;
}

// Solves in the logarithm of x, against which that of the azimuth is nearly straight.
double SkyTable::distance_beside_edge(double phi) const {
  if (level_) return level_->distance(phi);
  if (law_ && !zone_.winding) return law_->distance(phi);
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
  if (end_law_ && phi < curve_.value(x_split_)) {
    const double y = phi < end_law_->azimuth(end_law_->x_min) ? end_law_->distance(phi)
                                                              : end_curve_->inverse(phi, x_split_);
    return from_end(std::min(y, x_split_));
  }
  return std::min(curve_.inverse(phi, std::min(x_max_, x_split_)), x_max_);
}

}  // namespace domefall
