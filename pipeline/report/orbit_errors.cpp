#include "pipeline/report/orbit_errors.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "pipeline/report/integrated_fall.h"
#include "pipeline/report/orbit_cases.h"

namespace domefall {
namespace {

using Real = Real50;

// The outgoing tetrad is the time reversal of rain, so its radial celerity has the other sign.
FallState fall_state(const OrbitPoint& p) {
  return {p.r, p.azimuth, std::sqrt(1 + p.celerity.dot(p.celerity)),
          is_outgoing(p.tetrad) ? -p.celerity.x : p.celerity.x, p.celerity.z};
}

// Returns what the trajectory emits at the case's proper times.
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
    const bool summed = std::holds_alternative<Geodesic>(orbit.trajectory);
    rows.push_back(orbit_row(orbit, summed ? "quadrature" : "closed form", 0,
                             [&orbit] { return emitted(orbit); }));
    if (!orbit.integrated) continue;
    for (const double tolerance : tolerances) append_integrations(orbit, tolerance, rows);
  }
  return rows;
}

}  // namespace domefall
