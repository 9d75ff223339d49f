#include "trajectories/braked_flight.h"

#include <cmath>
#include <stdexcept>

#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/flight_table.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/short_number.h"
#include "trajectories/static_observer.h"

namespace domefall {
namespace {

constexpr double kSlowestFlight = 1e-6;  // of c

// A Braking goes along q, with r = r_1 + (r_0 - r_1) q^3 and psi = psi_0 q^2.  In q nothing is
// singular at the stop.
struct Braking {
  double from_r, stop_r, rapidity;

  struct Place {
    Radius at;
    double psi;
  };
  Place place(double q) const {
    const double above = (from_r - stop_r) * q * q * q;
    Radius at(stop_r + above);
    // Next to the horizon this has the digits that r has lost.
    at.above_horizon = (stop_r - 2) + above;
    return {at, rapidity * q * q};
  }

  // Here dr/dtau = -sqrt(f) sinh psi and dv/dtau = exp(-psi)/sqrt(f).
  FlightTable::Times rates(double q) const {
    const Place p = place(q);
    const double lapse = std::sqrt(Schwarzschild::lapse_squared(p.at));
    const double sine_ratio = p.psi > 0 ? std::sinh(p.psi) / p.psi : 1;
    const double rate = 3 * (from_r - stop_r) / (rapidity * lapse * sine_ratio);
    return {rate, rate * std::exp(-p.psi) / lapse};
  }
};

}  // namespace

struct BrakedFlight::Tables {
  Braking way;
  FlightTable times;
};

BrakedFlight::BrakedFlight(double from_r, double stop_r, double speed) {
  require_above("stop_r", "units of M", stop_r, kStaticInnermost,
                "nothing rests at the horizon or inside");
  require_above("from_r", "units of M", from_r, stop_r, "it comes in from there");
  require_at_least("speed", "fraction of c", speed, kSlowestFlight, "slower is at rest");
  require_below("speed", "fraction of c", speed, 1, "nothing outruns light");
  const Braking way{from_r, stop_r, std::atanh(speed)};
  tables_ = std::make_shared<const Tables>(
      Tables{way, FlightTable([&way](double q) { return way.rates(q); })});
}

double BrakedFlight::duration() const { return tables_->times.whole().tau; }
double BrakedFlight::birth() { return std::nextafter(0.0, -kInfinity); }

std::pair<double, double> BrakedFlight::reach() const {
  return {tables_->way.stop_r, tables_->way.from_r};
}

OrbitPoint BrakedFlight::at(const ProperTime& tau) const {
  if (!(tau >= ProperTime(0)))
    throw std::domain_error("proper time " + short_number(double(tau)) +
                            " (units of M) is before the flight");
  const Braking& way = tables_->way;
  const FlightTable& times = tables_->times;
  if (tau >= ProperTime(duration())) {
    OrbitPoint hover = StaticObserver{way.stop_r}.at(tau - duration());
    hover.null_time = hover.null_time + times.whole().null_time;
    return hover;
  }
  const double q = times.parameter(double(ProperTime(duration()) - tau));
  const Braking::Place p = way.place(q);
  // The rain moves inward with the speed s, whose Lorentz factor is 1/sqrt(f).
  const double s = Schwarzschild::free_fall_speed(p.at.r);
  const double celerity =
      (s * std::cosh(p.psi) - std::sinh(p.psi)) / std::sqrt(Schwarzschild::lapse_squared(p.at));
  return {Region::kI,       Tetrad::kRain,
          p.at.r,           0,
          {celerity, 0, 0}, DoubleDouble(times.whole().null_time) - times.to_go(q).null_time};
}

std::optional<ProperTime> BrakedFlight::time_at(double r, Leg leg, const ProperTime& after) const {
  const Braking& way = tables_->way;
  if (leg == Leg::kOutward || !(r >= way.stop_r && r <= way.from_r)) return std::nullopt;
  const double q = std::cbrt((r - way.stop_r) / (way.from_r - way.stop_r));
  const ProperTime tau = ProperTime(duration()) - tables_->times.to_go(q).tau;
  return tau >= after ? std::optional(tau) : std::nullopt;
}

}  // namespace domefall
