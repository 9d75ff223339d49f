// Observers near charges and naked singularities, in all regions and universes.
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "pipeline/light/charged_lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct ChargedPlace {
  double charge, r;
  Region region;
  Tetrad tetrad = Tetrad::kRain;
  int universe = 1;

  ObserverState observer() const {
    ObserverState o;
    o.spacetime = ChargedHole(1, charge);
    o.r = r, o.region = region, o.tetrad = tetrad, o.universe = universe;
    return o;
  }
};

inline std::ostream& operator<<(std::ostream& out, const ChargedPlace& p) {
  return out << "q " << p.charge << " r " << p.r << " " << region_name(p.region) << " "
             << tetrad_name(p.tetrad);
}

inline constexpr double kCharges[] = {1e-3, 0.05, 0.5, 0.8, 0.99, 1 - 1e-12, 1};
inline const double kNoCircle = std::sqrt(9.0 / 8);

// Places of views that are no Schwarzschild hole's, in every region where one differs.
inline std::vector<ChargedPlace> charged_places() {
  std::vector<ChargedPlace> all;
  const auto both = [&](double q, double r, Region region) {
    all.push_back({q, r, region, Tetrad::kRain});
    all.push_back({q, r, region, Tetrad::kOutgoing});
  };
  for (const double q : kCharges) {
    const ChargedHole hole(1, q);
    const double outer = hole.horizon(), inner = hole.inner_horizon(), end = hole.edges_end();
    for (const double r : {outer * 1.01, outer + 0.5, 2.9, 3.1, 10.0, 1e4}) both(q, r, Region::kI);
    if (q < 1)
      for (const double part : {0.02, 0.3, 0.98}) {
        const double r = inner + part * (outer - inner);
        all.push_back({q, r, Region::kIV, Tetrad::kOutgoing});
        all.push_back({q, r, Region::kII, Tetrad::kRain});
      }
    for (const double part : {0.01, 0.5, 0.99}) both(q, part * end, Region::kV);
    for (const double part : {0.1, 0.6}) both(q, end + part * (inner - end), Region::kV);
  }
  for (const double q :
       {1.0001, 1.02, 1.05, kNoCircle * (1 - 1e-5), kNoCircle * (1 + 1e-5), 1.2, 5.0})
    for (const double r : {0.01, 0.5, 1.0, 1.4, 1.9, 3.0, 1e3}) both(q, r, Region::kI);
  return all;
}

// Places next to those that mark a hole, and on them.
inline std::vector<ChargedPlace> marked_places() {
  std::vector<ChargedPlace> all;
  for (const double q : kCharges) {
    const ChargedHole hole(1, q);
    const double outer = hole.horizon(), inner = hole.inner_horizon(), end = hole.edges_end();
    for (const double off : {0.0, 1e-15, 1e-9}) {
      for (const Tetrad tetrad : {Tetrad::kRain, Tetrad::kOutgoing}) {
        all.push_back({q, inner * (1 - off), Region::kV, tetrad});
        all.push_back({q, outer * (1 + off), Region::kI, tetrad});
        for (const double side : {-1.0, 1.0})
          all.push_back({q, std::min(end * (1 + side * off), inner), Region::kV, tetrad});
        all.push_back({q, hole.light_circle() * (1 + off), Region::kI, tetrad});
      }
      if (q == 1) continue;
      all.push_back({q, inner * (1 + off), Region::kIV, Tetrad::kOutgoing});
      all.push_back({q, inner * (1 + off), Region::kII, Tetrad::kRain});
      all.push_back({q, outer * (1 - off), Region::kIV, Tetrad::kOutgoing});
    }
  }
  for (const double q : {kNoCircle * (1 - 1e-15), kNoCircle, kNoCircle * (1 + 1e-15), 1.0001})
    for (const double r : {1.0, 1.5, 1.5 * (1 - 1e-15), 2.0, 30.0})
      all.push_back({q, r, Region::kI});
  return all;
}

inline HoleOptics optics_at(const ChargedPlace& place, bool tables = true) {
  const ObserverState o = place.observer();
  HoleOptics optics = make_charged_optics(std::get<ChargedHole>(o.spacetime.kind()), o);
  if (tables) add_tables(optics, {});
  return optics;
}

}  // namespace domefall
