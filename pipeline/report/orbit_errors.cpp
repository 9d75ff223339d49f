#include "pipeline/report/orbit_errors.h"

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

#include "pipeline/report/free_fall.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

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
  std::function<Place(double)> exact_place;
};

template <class Kind>
Orbit orbit_of(std::string name, const Kind& kind, std::vector<double> taus, bool integrated) {
  return {std::move(name), kind,
          std::move(taus), integrated,
          constants(kind), [kind](double tau) { return place(kind, tau); }};
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
          orbit_of("static at 2.1 M", StaticObserver{2.1}, minute, false)};
}

FallState fall_state(const OrbitPoint& p) {
  return {p.r, p.azimuth, std::sqrt(1 + p.celerity.dot(p.celerity)), p.celerity.x, p.celerity.z};
}

std::vector<FallState> closed_form(const Orbit& orbit) {
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
    const Place exact = orbit.exact_place(orbit.taus[k]);
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
    rows.push_back(row_of(orbit, "closed form", 0, [&orbit] { return closed_form(orbit); }));
    if (!orbit.integrated) continue;
    for (const double tolerance : tolerances) append_integrations(orbit, tolerance, rows);
  }
  return rows;
}

}  // namespace domefall
