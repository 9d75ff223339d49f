#include "pipeline/report/orbit_errors.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

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

constexpr double kFallEnd = 1e-3;  // M

// An orbit's formulas once more, with 50 digits.
struct Constants {
  Real energy, angular_momentum;
};
struct Place {
  Real r, azimuth;
};

Constants constants(const CircularOrbit& orbit) {
  const Real r = orbit.r;
  return {(1 - 2 / r) / sqrt(1 - 3 / r), sqrt(r / (1 - 3 / r))};
}
Place place(const CircularOrbit& orbit, double tau) {
  const Real r = orbit.r;
  return {r, tau / (r * sqrt(r - 3))};
}

Constants constants(const RadialInfall& /*fall*/) { return {1, 0}; }
Place place(const RadialInfall& fall, double tau) {
  const Real from = fall.from_r;
  const Real root = cbrt(Real(from * sqrt(from) - 3 * Real(tau) / sqrt(Real(2))));
  return {root * root, 0};
}

Constants constants(const StaticObserver& observer) { return {sqrt(1 - 2 / Real(observer.r)), 0}; }
Place place(const StaticObserver& observer, double /*tau*/) { return {observer.r, 0}; }

struct Orbit {
  std::string name;
  Trajectory trajectory;
  std::vector<double> taus;
  bool integrated;
  Constants exact;
  std::vector<Place> places;
};

template <class Kind>
Orbit orbit_of(std::string name, const Kind& kind, const std::vector<double>& taus,
               bool integrated) {
  std::vector<Place> places;
  places.reserve(taus.size());
  for (const double tau : taus) places.push_back(place(kind, tau));
  return {std::move(name), kind, taus, integrated, constants(kind), std::move(places)};
}

std::vector<double> evenly(double end, int states) {
  std::vector<double> taus;
  for (int k = 1; k <= states; ++k) taus.push_back(end * k / states);
  return taus;
}

std::vector<double> evenly_in_log_r(const RadialInfall& fall, int states) {
  std::vector<double> taus;
  for (int k = 1; k <= states; ++k)
    taus.push_back(
        proper_time_to(fall, fall.from_r * std::pow(kFallEnd / fall.from_r, double(k) / states)));
  return taus;
}

// ---- geodesics without a closed form ----

// At the proper times as they are rounded, to which the reference's are brought by its speed.
Orbit geodesic_of(std::string name, const Geodesic& geodesic, const ReferenceOrbit& reference,
                  const std::vector<ReferencePlace>& path, int way, bool integrated) {
  Orbit orbit{std::move(name),
              geodesic,
              {},
              integrated,
              {reference.energy(), reference.angular_momentum},
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

// A geometric series of distances from `from`, which must be a turning point.
std::vector<Real> radii_beyond(const Real& from, double first, double last, int states) {
  std::vector<Real> radii;
  radii.reserve(static_cast<std::size_t>(states));
  for (int k = 0; k < states; ++k)
    radii.emplace_back(from + first * std::pow(last / first, double(k) / (states - 1)));
  return radii;
}

std::vector<Real> radii_to(double from, double to, int states) {
  std::vector<Real> radii;
  radii.reserve(static_cast<std::size_t>(states));
  for (int k = 1; k <= states; ++k)
    radii.emplace_back(from * std::pow(to / from, double(k) / states));
  return radii;
}

constexpr double kBesideTheTurn = 1e-9;  // M
constexpr double kFarAway = 1000;

Orbit parabola(int states) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  const ReferenceOrbit reference = orbit_between(10, infinity);
  return geodesic_of(
      "parabola from 10 M to 1000 M", parabolic_by_periastron(10), reference,
      reference_leg(reference, 10, radii_beyond(10, kBesideTheTurn, kFarAway, states)), 1, true);
}

Orbit hyperbola(int states) {
  const double speed = 0.5, turn = 3.6;
  const Real v = speed, r = turn, excess = v * v / (1 - v * v);
  const ReferenceOrbit reference{excess, r * sqrt(Real((1 + excess) * r / (r - 2) - 1))};
  return geodesic_of(
      "hyperbola of c/2 from 3.6 M to 1000 M", hyperbolic_by_periastron(speed, turn), reference,
      reference_leg(reference, r, radii_beyond(r, kBesideTheTurn, kFarAway, states)), 1, true);
}

// As many states each turn, on the way out between 11 and 15 M.
Orbit ellipse(int states) {
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
  return geodesic_of("bound from 10 to 20 M, 100 turns", bound_by_turning_points(10, 20), reference,
                     path, 1, true);
}

Orbit whirl(int states) {
  const double e = 0.5, excess = 1e-8;
  const Real p = 6 + 2 * Real(e) + Real(excess), near = p / (1 + Real(e));
  const ReferenceOrbit reference = orbit_between(near, p / (1 - Real(e)));
  const auto path = reference_leg(reference, near, radii_beyond(near, kBesideTheTurn, 9, states));
  return geodesic_of("whirl at p - 6 - 2e = 1e-8 M, e = 1/2", bound_by_excess(e, excess), reference,
                     path, 1, true);
}

Orbit plunge(int states) {
  const ReferenceOrbit reference{0, 3.9};
  return geodesic_of("fall with L = 3.9 M from 30 M to 0.001 M", fall_from_infinity(3.9, 30),
                     reference, reference_leg(reference, 30, radii_to(30, kFallEnd, states)), -1,
                     true);
}

// Without integrations, which are in the rain tetrad.
Orbit crossing(int states) {
  const double energy = 1.25, momentum = 1;
  const ReferenceOrbit reference{Real(energy) * energy - 1, momentum};
  std::vector<ReferencePlace> path = reference_leg(reference, 2, radii_to(2, 0.01, states / 2));
  for (ReferencePlace& at : path) at.tau = -at.tau, at.azimuth = -at.azimuth;
  for (const ReferencePlace& at : reference_leg(reference, 2, radii_to(2, 100, states / 2)))
    path.push_back(at);
  return geodesic_of("from 0.01 M in region IV to 100 M, E = 1.25, L = 1 M",
                     kruskal_crossing(energy, momentum), reference, path, 1, false);
}

std::vector<Orbit> orbits(int states) {
  const auto circle = [states](std::string name, double r, int turns, bool integrated) {
    const CircularOrbit orbit{r};
    return orbit_of(std::move(name), orbit, evenly(turns * period(orbit), states), integrated);
  };
  const RadialInfall fall{30};
  const std::vector<double> minute = evenly(60, states);
  return {circle("circular at 6 M, 100 turns", 6, 100, true),
          circle("circular at 10 M, 100 turns", 10, 100, true),
          circle("circular at 3.1 M, 3 turns", 3.1, 3, true),
          circle("circular at 3.1 M, 100 turns", 3.1, 100, false),
          orbit_of("fall from 30 M to 0.001 M", fall, evenly_in_log_r(fall, states), true),
          orbit_of("static at 6 M", StaticObserver{6}, minute, false),
          orbit_of("static at 2.1 M", StaticObserver{2.1}, minute, false),
          parabola(states),
          hyperbola(states),
          ellipse(states),
          whirl(states),
          plunge(states),
          crossing(states)};
}

// The outgoing tetrad is rain's mirror image.
FallState fall_state(const OrbitPoint& p) {
  return {p.r, p.azimuth, std::sqrt(1 + p.celerity.dot(p.celerity)),
          is_outgoing(p.tetrad) ? -p.celerity.x : p.celerity.x, p.celerity.z};
}

std::vector<FallState> emitted(const Orbit& orbit) {
  std::vector<FallState> states;
  states.reserve(orbit.taus.size());
  for (const double tau : orbit.taus) states.push_back(fall_state(point_at(orbit.trajectory, tau)));
  return states;
}

void raise(double& largest, const Real& value) {
  largest = std::max(largest, static_cast<double>(abs(value)));
}

// own_gamma: the method emits gamma itself.
void compare(const Orbit& orbit, const std::vector<FallState>& states, bool own_gamma,
             OrbitErrorRow& row) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Place& exact = orbit.places[k];
    const Real r = states[k].r, w = states[k].radial, v = states[k].tangential;
    raise(row.r_error, (r - exact.r) / exact.r);
    raise(row.phi_error, states[k].azimuth - exact.azimuth);
    if (r == 0) continue;
    const Real s = sqrt(2 / r), squares = w * w + v * v, own = states[k].gamma;
    const Real of_norm = own_gamma ? own : Real(sqrt(1 + squares));
    const Real of_energy = own_gamma ? own : Real(orbit.exact.energy + s * w);
    raise(row.energy_drift, of_norm - s * w - orbit.exact.energy);
    raise(row.angular_momentum_drift, r * v - orbit.exact.angular_momentum);
    raise(row.norm_drift, of_energy * of_energy - squares - 1);
  }
}

// CPU seconds of one call, by the quickest of several rounds of a millisecond or more each.
template <class Function>
double seconds_of(const Function& function) {
  constexpr int kRounds = 3;
  constexpr double kRound = 1e-3;
  constexpr int kMostCalls = 100'000;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const std::clock_t start = std::clock();
    double passed = 0;
    int calls = 0;
    while (passed < kRound && calls < kMostCalls) {
      function(), ++calls;
      passed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    best = std::min(best, passed / calls);
  }
  return best;
}

template <class Method>
OrbitErrorRow row_of(const Orbit& orbit, const char* name, double tolerance, const Method& method) {
  OrbitErrorRow row{orbit.name, name, tolerance, 0, 0, 0, 0, 0, 0};
  compare(orbit, method(), tolerance > 0, row);
  row.seconds = seconds_of(method) * 1000 / static_cast<double>(orbit.taus.size());
  return row;
}

void append_integrations(const Orbit& orbit, double tolerance, std::vector<OrbitErrorRow>& rows) {
  const FallState start = fall_state(point_at(orbit.trajectory, 0));
  const auto append = [&](const char* name, FallMethod method) {
    rows.push_back(row_of(orbit, name, tolerance, [&orbit, &start, method, tolerance] {
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
  for (const Orbit& orbit : orbits(quick ? 100 : 1000)) {
    const bool summed = std::holds_alternative<Geodesic>(orbit.trajectory);
    rows.push_back(row_of(orbit, summed ? "quadrature" : "closed form", 0,
                          [&orbit] { return emitted(orbit); }));
    if (!orbit.integrated) continue;
    for (const double tolerance : tolerances) append_integrations(orbit, tolerance, rows);
  }
  return rows;
}

}  // namespace domefall
