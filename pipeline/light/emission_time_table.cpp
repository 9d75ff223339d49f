#include "pipeline/light/emission_time_table.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/emission_time.h"
#include "pipeline/light/exact_azimuth.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// Returns the observer's t less its v or u, whichever times count from.
double own_time(const WhiteHoleTable& table) {
  const double star = Schwarzschild::tortoise(table.at());
  return table.is_outgoing() ? star : -star;
}

}  // namespace

// Outside, times count from the observer's null coordinate.  Elsewhere they count from the
// observer's t, and are of |E|.
double EmissionTimeTable::time_at_place(const WhiteHoleTable& table, double s) const {
  const double time = exact_emission_time(table.ray_at_place(s));
  return odd_ ? offset_ - time : time;
}

EmissionTimeTable::EmissionTimeTable(const WhiteHoleTable& table, int bits)
    : odd_(table.at().above_horizon < 0),
      offset_(odd_ ? own_time(table) : 0),
      phi_share_(table.has_edge() ? Schwarzschild::kCriticalImpact : 0),
      range_(table.curve_range()),
      curve_(
          range_.low, range_.high,
          [&](double s) {
            const double rest =
                phi_share_ * (phi_share_ > 0 ? exact_azimuth(table.ray_at_place(s)) : 0);
            return time_at_place(table, s) + rest;
          },
          bits),
      axis_above_(!odd_),
      axis_below_(!table.has_edge()) {
  if (!axis_above_ && !axis_below_) return;
  const double end = axis_above_ ? range_.high : range_.low;
  end_time_ = time_at_place(table, end);
  end_azimuth_ = exact_azimuth(table.ray_at_place(end));
  // Radial light keeps its u.
  if (axis_below_)
    axis_time_ = -Schwarzschild::tortoise(table.at());
  else
    axis_time_ = table.is_outgoing() ? 0 : -2 * Schwarzschild::tortoise(table.at());
}

EmissionTimeTable::Value EmissionTimeTable::at(const WhiteHoleTable::Place& place, bool beyond,
                                               double azimuth, double slope) const {
  const double side = odd_ && !beyond ? -1 : 1;
  if ((axis_above_ && place.s > range_.high) || (axis_below_ && place.s < range_.low)) {
    const double part = azimuth / end_azimuth_, moved = end_time_ - axis_time_;
    return {side * (axis_time_ + moved * part * part * part * part) + offset_,
            std::abs(4 * moved * part * part * part / end_azimuth_ * slope)};
  }
  const OctaveCurve::Jet jet = curve_.at(std::clamp(place.s, range_.low, range_.high));
  // Towards an edge, where s is beyond the curve, all of the slope is phi's.
  const double own = place.s < range_.low ? 0 : jet.first * std::abs(place.rate);
  return {side * (jet.value - phi_share_ * azimuth) + offset_, std::abs(own + phi_share_ * slope)};
}

}  // namespace domefall
