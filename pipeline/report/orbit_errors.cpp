#include "pipeline/report/orbit_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/stop_watch.h"
#include "pipeline/report/integrated_fall.h"
#include "pipeline/report/reference/reference_orbit.h"
#include "trajectories/bound_orbit.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/kruskal_crossing.h"
#include "trajectories/parabolic_orbit.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

using Real = Real50;

struct ExactPlace {
  Real50 r, azimuth;  // M, radians
};

struct OrbitCase {
  std::string name;
  const char* method;  // by which the trajectory finds its states
  Trajectory trajectory;
  std::vector<double> taus;  // proper times of the states, M
  bool integrated;           // whether the orbit is also integrated step by step
  // The truth is the two constants of the motion and the place at each proper time.  It depends on
  // no code of trajectories.
  Real50 energy, angular_momentum;
  std::vector<ExactPlace> places;
};

constexpr double kLastRadius = 1e-3;  // M

// ---- orbits with a closed form ----

struct Constants {
  Real energy, angular_momentum;
};

// On a circle E = (1 - 2/r)/sqrt(1 - 3/r) and L^2 = r/(1 - 3/r), so dphi/dtau = L/r^2 is
// 1/(r sqrt(r - 3)).
Constants constants(const CircularOrbit& orbit) {
  const Real r = orbit.r;
  return {(1 - 2 / r) / sqrt(1 - 3 / r), sqrt(r / (1 - 3 / r))};
}
ExactPlace place(const CircularOrbit& orbit, double tau) {
  const Real r = orbit.r;
  return {r, tau / (r * sqrt(r - 3))};
}

// The rain falls by dr/dtau = -sqrt(2/r), so the rate of r^(3/2) is (3/2) sqrt(r) dr/dtau =
// -3/sqrt(2), and r^(3/2) = r_0^(3/2) - 3 tau/sqrt(2).
Constants constants(const RadialInfall& /*fall*/) { return {1, 0}; }
ExactPlace place(const RadialInfall& fall, double tau) {
  const Real from = fall.from_r;
  const Real root = cbrt(Real(from * sqrt(from) - 3 * Real(tau) / sqrt(Real(2))));
  return {root * root, 0};
}

// The energy of an observer at rest is u_t = sqrt(1 - 2/r).
Constants constants(const StaticObserver& observer) { return {sqrt(1 - 2 / Real(observer.r)), 0}; }
ExactPlace place(const StaticObserver& observer, double /*tau*/) { return {observer.r, 0}; }

// Returns a case of a closed form.  Its truth is evaluated at the same doubles as the trajectory,
// so the rounding of a proper time is no error here.
template <class Kind>
OrbitCase closed_form_case(std::string name, const Kind& kind, const std::vector<double>& taus,
                           bool integrated) {
  const auto [energy, angular_momentum] = constants(kind);
  OrbitCase orbit{std::move(name), "closed form",    kind, taus, integrated,
                  energy,          angular_momentum, {}};
  orbit.places.reserve(taus.size());
  for (const double tau : taus) orbit.places.push_back(place(kind, tau));
  return orbit;
}

std::vector<double> evenly(double end, int states) {
  std::vector<double> taus;
  for (int k = 1; k <= states; ++k) taus.push_back(end * k / states);
  return taus;
}

// Returns the proper times at which r has fallen by equal factors.  The time to each r is rounded
// to a double, which place() then takes as it is.
std::vector<double> evenly_in_log_r(const RadialInfall& fall, int states) {
  std::vector<double> taus;
  for (int k = 1; k <= states; ++k)
    taus.push_back(double(proper_time_to(
        fall, fall.from_r * std::pow(kLastRadius / fall.from_r, double(k) / states))));
  return taus;
}

OrbitCase circle(std::string name, double r, int turns, int states, bool integrated) {
  const CircularOrbit orbit{r};
  return closed_form_case(std::move(name), orbit, evenly(turns * period(orbit), states),
                          integrated);
}

// ---- geodesics without a closed form ----

// The trajectory is evaluated at the reference's proper times, rounded to double.  The rounding of
// tau moves the true place by the rounding times the reference's speed, to first order.  `way` is
// +1 outwards and -1 inwards.
OrbitCase geodesic_case(std::string name, const Geodesic& geodesic, const ReferenceOrbit& reference,
                        const std::vector<ReferencePlace>& path, int way, bool integrated) {
  OrbitCase orbit{std::move(name),
                  "quadrature",
                  geodesic,
                  {},
                  integrated,
                  reference.energy(),
                  reference.angular_momentum,
                  {}};
  for (const ReferencePlace& at : path) {
    const auto tau = static_cast<double>(at.tau);
    const Real rest = tau - at.tau;
    orbit.taus.push_back(tau);
    orbit.places.push_back({at.r + way * rest * reference.radial_speed(at.r),
                            at.azimuth + rest * reference.angular_momentum / (at.r * at.r)});
  }
  return orbit;
}

// Returns radii outside the turning point `turn`, whose distances from it form a geometric series.
std::vector<Real> radii_beyond(const Real& turn, double first, double last, int states) {
  std::vector<Real> radii;
  radii.reserve(static_cast<std::size_t>(states));
  for (int k = 0; k < states; ++k)
    radii.emplace_back(turn + first * std::pow(last / first, double(k) / (states - 1)));
  return radii;
}

std::vector<Real> radii_to(double from, double to, int states) {
  std::vector<Real> radii;
  radii.reserve(static_cast<std::size_t>(states));
  for (int k = 1; k <= states; ++k)
    radii.emplace_back(from * std::pow(to / from, double(k) / states));
  return radii;
}

// The nearest state is so close to the turning point that r - turn has lost most digits of a
// double.  There tau grows like sqrt(r - turn), since the radial speed does.
constexpr double kBesideTheTurn = 1e-9;  // M
constexpr double kFarAway = 1000;        // M

// It has E = 1, so that it comes to rest at infinity, where orbit_between() takes it to turn.
OrbitCase parabola(int states) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  const ReferenceOrbit reference = orbit_between(10, infinity);
  return geodesic_case(
      "parabola from 10 M to 1000 M", parabolic_by_periastron(10), reference,
      reference_leg(reference, 10, radii_beyond(10, kBesideTheTurn, kFarAway, states)), 1, true);
}

// The speed v at infinity gives E^2 - 1 = v^2/(1 - v^2).  At the turning point r the radial speed
// is 0, so E^2 = (1 - 2/r)(1 + L^2/r^2), which is solved for L.  An orbit that turns at 3.6 M needs
// a speed above sqrt(4 - 3.6)/(3.6 - 2) = 0.395 ([Riazuelo] app. app_img), so 0.5 is well above the
// whirl.
OrbitCase hyperbola(int states) {
  const double speed = 0.5, turn = 3.6;
  const Real v = speed, r = turn, excess = v * v / (1 - v * v);
  const ReferenceOrbit reference{excess, r * sqrt(Real((1 + excess) * r / (r - 2) - 1))};
  return geodesic_case(
      "hyperbola of c/2 from 3.6 M to 1000 M", hyperbolic_by_periastron(speed, turn), reference,
      reference_leg(reference, r, radii_beyond(r, kBesideTheTurn, kFarAway, states)), 1, true);
}

// Every turn has equally many states, all on the way out between 10.2 and 15 M.  Half a turn is the
// time and the azimuth from 10 to 15 M and from there to 20 M.  The second leg is computed from its
// turning point, from 20 down to 15 M, and takes as long by symmetry.
OrbitCase ellipse(int states) {
  const Real near = 10, far = 20;
  const ReferenceOrbit reference = orbit_between(near, far);
  constexpr int kTurns = 100, kSteps = 64;
  const auto rising = reference_leg(reference, near, radii_beyond(near, kBesideTheTurn, 5, kSteps));
  std::vector<Real> down = radii_beyond(far, kBesideTheTurn, 5, kSteps);
  for (Real& r : down) r = 2 * far - r;
  const auto falling = reference_leg(reference, far, down);
  std::vector<ReferencePlace> path;
  const int each = states / kTurns;
  for (int turn = 0; turn < kTurns; ++turn)
    for (int k = 0; k < each; ++k) {
      ReferencePlace at = rising[static_cast<std::size_t>(kSteps - each + k)];
      at.tau += 2 * turn * (rising.back().tau + falling.back().tau);
      at.azimuth += 2 * turn * (rising.back().azimuth + falling.back().azimuth);
      path.push_back(at);
    }
  return geodesic_case("bound from 10 to 20 M, 100 turns", bound_by_turning_points(10, 20),
                       reference, path, 1, true);
}

// The orbit turns at p/(1 + e) = 4.67 M and p/(1 - e) = 14 M.  With p = 6 + 2e it would whirl for
// ever at its periastron.  A double near 7 holds an excess of 1e-8 to seven digits only, so the
// trajectory and the reference are both made from the excess itself.
OrbitCase whirl(int states) {
  const double e = 0.5, excess = 1e-8;
  const Real p = 6 + 2 * Real(e) + Real(excess), near = p / (1 + Real(e));
  const ReferenceOrbit reference = orbit_between(near, p / (1 - Real(e)));
  const auto path = reference_leg(reference, near, radii_beyond(near, kBesideTheTurn, 9, states));
  return geodesic_case("whirl at p - 6 - 2e = 1e-8 M, e = 1/2", bound_by_excess(e, excess),
                       reference, path, 1, true);
}

// With E = 1 the radial speed is 0 where 2 r^2 - L^2 r + 2 L^2 = 0.  For L < 4 M this has no real
// root ([Riazuelo] eq. r_par), so the body falls to the singularity.
OrbitCase plunge(int states) {
  const ReferenceOrbit reference{0, 3.9};
  return geodesic_case("fall with L = 3.9 M from 30 M to 0.001 M", fall_from_infinity(3.9, 30),
                       reference, reference_leg(reference, 30, radii_to(30, kLastRadius, states)),
                       -1, true);
}

// Proper time and azimuth count from the horizon, so both are negative in region IV.  The orbit is
// not integrated, because integrate_fall works in the rain tetrad, which does not exist in region
// IV.
OrbitCase crossing(int states) {
  const double energy = 1.25, momentum = 1;
  const ReferenceOrbit reference{Real(energy) * energy - 1, momentum};
  std::vector<ReferencePlace> path = reference_leg(reference, 2, radii_to(2, 0.01, states / 2));
  // The reference counts from r = 2 inwards, that is back in time.
  for (ReferencePlace& at : path) at.tau = -at.tau, at.azimuth = -at.azimuth;
  for (const ReferencePlace& at : reference_leg(reference, 2, radii_to(2, 100, states / 2)))
    path.push_back(at);
  return geodesic_case("from 0.01 M in region IV to 100 M, E = 1.25, L = 1 M",
                       kruskal_crossing(energy, momentum), reference, path, 1, false);
}

// Returns all orbits, each with `states` states.
//
// There are circular orbits at 6 and 10 M over 100 turns, and at 3.1 M over 3 turns and over 100.
// The circle at 3.1 M is unstable: an error grows by exp(2 pi sqrt(6/r - 1)), more than 400-fold,
// with every turn.  So only the closed form is tried over 100 turns.
//
// The radial fall goes from 30 M to 0.001 M, and its states are evenly spaced in log r.  Static
// observers do not fall and therefore are not integrated.
//
// The geodesics without a closed form are a parabola and a hyperbola outwards from their turning
// points, a bound orbit over 100 turns, an orbit that whirls almost for ever, a fall with angular
// momentum, and a geodesic out of region IV.
std::vector<OrbitCase> orbit_cases(int states) {
  const RadialInfall fall{30};
  // A static observer stays where it is, so any proper times would do.
  const std::vector<double> minute = evenly(60, states);
  return {circle("circular at 6 M, 100 turns", 6, 100, states, true),
          circle("circular at 10 M, 100 turns", 10, 100, states, true),
          circle("circular at 3.1 M, 3 turns", 3.1, 3, states, true),
          circle("circular at 3.1 M, 100 turns", 3.1, 100, states, false),
          closed_form_case("fall from 30 M to 0.001 M", fall, evenly_in_log_r(fall, states), true),
          closed_form_case("static at 6 M", StaticObserver{6}, minute, false),
          closed_form_case("static at 2.1 M", StaticObserver{2.1}, minute, false),
          parabola(states),
          hyperbola(states),
          ellipse(states),
          whirl(states),
          plunge(states),
          crossing(states)};
}

// ---- errors ----

// The outgoing tetrad is the time reversal of rain, so its radial celerity has the other sign.
FallState fall_state(const OrbitPoint& p) {
  return {p.r, p.azimuth, gamma_of(p.celerity),
          is_outgoing(p.tetrad) ? -p.celerity.x : p.celerity.x, p.celerity.z};
}

std::vector<FallState> emitted(const OrbitCase& orbit) {
  std::vector<FallState> states;
  states.reserve(orbit.taus.size());
  for (const double tau : orbit.taus) states.push_back(fall_state(point_at(orbit.trajectory, tau)));
  return states;
}

void raise(double& largest, const Real& value) {
  largest = std::max(largest, static_cast<double>(abs(value)));
}

// Raises the errors of the row to those of these states.  own_gamma says whether the method emits
// gamma itself.
//
// The four-velocity is u = gamma T + w R + v Phi, and d/dt = T + s R with s = sqrt(2/r), as the
// components of [Riazuelo] eq. tetrad_start show.  So the energy u.(d/dt) is gamma - s w, the
// angular momentum is r v, and u.u = gamma^2 - w^2 - v^2.  Where gamma is not emitted, one of the
// two equations of energy and norm must give it, and the other one is the test.
void raise_errors(const OrbitCase& orbit, const std::vector<FallState>& states, bool own_gamma,
                  OrbitErrorRow& row) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const ExactPlace& exact = orbit.places[k];
    const Real r = states[k].r, w = states[k].radial, v = states[k].tangential;
    raise(row.r_error, (r - exact.r) / exact.r);
    raise(row.phi_error, states[k].azimuth - exact.azimuth);
    if (r == 0) continue;
    const Real s = sqrt(2 / r), squares = w * w + v * v, own = states[k].gamma;
    const Real of_norm = own_gamma ? own : Real(sqrt(1 + squares));
    const Real of_energy = own_gamma ? own : Real(orbit.energy + s * w);
    raise(row.energy_drift, of_norm - s * w - orbit.energy);
    raise(row.angular_momentum_drift, r * v - orbit.angular_momentum);
    raise(row.norm_drift, of_energy * of_energy - squares - 1);
  }
}

// Returns the CPU seconds of one call, by the quickest of several rounds.  A round lasts a
// millisecond or more, which is long against a tick of the clock, unless it would take too many
// calls.
template <class Function>
double seconds_of(const Function& function) {
  constexpr int kRounds = 3;
  constexpr double kRound = 1e-3;
  constexpr int kMostCalls = 100'000;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const double start = processor_seconds();
    double passed = 0;
    int calls = 0;
    while (passed < kRound && calls < kMostCalls) {
      function(), ++calls;
      passed = processor_seconds() - start;
    }
    best = std::min(best, passed / calls);
  }
  return best;
}

// Returns the row of a method, a function that returns all states of the orbit at each call.
template <class Method>
OrbitErrorRow orbit_row(const OrbitCase& orbit, const char* name, double tolerance,
                        const Method& method) {
  OrbitErrorRow row{orbit.name, name, tolerance, 0, 0, 0, 0, 0, 0};
  raise_errors(orbit, method(), tolerance > 0, row);
  row.seconds = seconds_of(method) * 1000 / static_cast<double>(orbit.taus.size());
  return row;
}

// Appends the rows of both integrators.  They start from the state that the trajectory emits at tau
// = 0, so that its rounding is a part of their error.
void append_integrations(const OrbitCase& orbit, double tolerance,
                         std::vector<OrbitErrorRow>& rows) {
  const FallState start = fall_state(point_at(orbit.trajectory, 0));
  const auto append = [&](const char* name, FallMethod method) {
    rows.push_back(orbit_row(orbit, name, tolerance, [&orbit, &start, method, tolerance] {
      return integrate_fall(start, orbit.taus, method, tolerance);
    }));
  };
  append("dopri5", FallMethod::kDopri5);
  append("fehlberg78", FallMethod::kFehlberg78);
}

}  // namespace

std::vector<OrbitErrorRow> measure_orbits(bool quick) {
  const std::vector<double> tolerances =
      quick ? std::vector{1e-6, 1e-9} : std::vector{1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
  std::vector<OrbitErrorRow> rows;
  for (const OrbitCase& orbit : orbit_cases(quick ? 100 : 1000)) {
    rows.push_back(orbit_row(orbit, orbit.method, 0, [&orbit] { return emitted(orbit); }));
    if (!orbit.integrated) continue;
    for (const double tolerance : tolerances) append_integrations(orbit, tolerance, rows);
  }
  return rows;
}

}  // namespace domefall
