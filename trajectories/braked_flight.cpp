#include "trajectories/braked_flight.h"

#include <cmath>
#include <stdexcept>

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
  Spacetime spacetime;
  double from_r, stop_r, rapidity;

  struct Place {
    double r, lapse, psi;
  };
  Place place(double q) const {
    const double above = (from_r - stop_r) * q * q * q, r = stop_r + above;
    // Next to the horizon the sum has the digits that r has lost.
    const double f = spacetime.lapse_squared_above(r, spacetime.above_horizon(stop_r) + above);
    return {r, std::sqrt(f), rapidity * q * q};
  }

  // Here dr/dtau = -sqrt(f) sinh psi and dv/dtau = exp(-psi)/sqrt(f).
  FlightTable::Times rates(double q) const {
    const Place p = place(q);
    const double sine_ratio = p.psi > 0 ? std::sinh(p.psi) / p.psi : 1;
    const double rate = 3 * (from_r - stop_r) / (rapidity * p.lapse * sine_ratio);
    return {rate, rate * std::exp(-p.psi) / p.lapse};
  }
};

}  // namespace

struct BrakedFlight::Tables {
  Braking way;
  FlightTable times;
};

BrakedFlight::BrakedFlight(double from_r, double stop_r, double speed, const Spacetime& spacetime) {
  require_above("stop_r", "units of M", stop_r, spacetime.horizon(),
                "nothing rests at the horizon or inside");
  require_above("from_r", "units of M", from_r, stop_r, "it comes in from there");
  require_at_least("speed", "fraction of c", speed, kSlowestFlight, "slower is at rest");
  require_below("speed", "fraction of c", speed, 1, "nothing outruns light");
  const Braking way{spacetime, from_r, stop_r, std::atanh(speed)};
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
    OrbitPoint hover = StaticObserver{way.stop_r, way.spacetime}.at(tau - duration());
    hover.null_time = hover.null_time + times.whole().null_time;
    return hover;
  }
  const double q = times.parameter(double(ProperTime(duration()) - tau));
  const Braking::Place p = way.place(q);
  // What rests is d/dt over sqrt(f).
  const auto [t, s] = way.spacetime.static_time(p.r);
  const double celerity = (s * std::cosh(p.psi) - t * std::sinh(p.psi)) / p.lapse;
  return {Region::kI,
          Tetrad::kRain,
          p.r,
          0,
          {celerity, 0, 0},
          DoubleDouble(times.whole().null_time) - times.to_go(q).null_time};
}

std::optional<ProperTime> BrakedFlight::time_at(double r, Leg leg, const ProperTime& after) const {
  const Braking& way = tables_->way;
  if (leg == Leg::kOutward || !(r >= way.stop_r && r <= way.from_r)) return std::nullopt;
  const double q = std::cbrt((r - way.stop_r) / (way.from_r - way.stop_r));
  const ProperTime tau = ProperTime(duration()) - tables_->times.to_go(q).tau;
  return tau >= after ? std::optional(tau) : std::nullopt;
}

}  // namespace domefall
