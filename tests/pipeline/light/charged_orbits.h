// Orbits of light near a charge, by small steps in long double.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/spacetime/charged.h"

namespace domefall {

// p and |e| of a ray of T by tan(alpha/2).
struct Label {
  double p, e;
};
inline Label label_of(const ChargedHole& hole, double r, double tangent) {
  const double f = hole.lapse_squared(r);
  return {(f / tangent - tangent) / (2 * r), std::abs(f / tangent + tangent) / (2 * r)};
}

struct Followed {
  bool at_sky = false, past = false;
  long double w, slope, time = 0;
};

// The orbit's equation and dv/dpsi by Runge and Kutta's fourth order, in steps by the size of w.
// With e^2 - w'^2 = f w^2 dv/dpsi is -1/(e - w') = -(e + w')/(f w^2), of which one form cancels.
inline Followed follow(const ChargedHole& hole, double r, const Label& label, double psi) {
  const long double q2 = 1.0L * hole.charge * hole.charge, e = label.e;
  struct Rates {
    long double w, slope, time;
  };
  const auto rates = [&](const Followed& at) {
    const long double w = at.w, f = 1 + w * (-2 + q2 * w);
    return Rates{at.slope, w * (-1 + w * (3 - 2 * q2 * w)),
                 at.slope < 0 ? -1 / (e - at.slope) : -(e + at.slope) / (f * w * w)};
  };
  const auto moved = [](const Followed& at, const Rates& by, long double h) {
    Followed out = at;
    out.w += h * by.w, out.slope += h * by.slope, out.time += h * by.time;
    return out;
  };
  Followed at{false, false, 1.0L / r, label.p};
  for (long double left = psi; left > 0;) {
    const long double h =
        std::min({left, 1e-3L / (1 + std::sqrt(e)), 2e-3L * at.w / (e + std::abs(at.slope))});
    const Rates a = rates(at), b = rates(moved(at, a, h / 2)), c = rates(moved(at, b, h / 2)),
                d = rates(moved(at, c, h));
    at = moved(moved(moved(moved(at, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    left -= h;
    at.at_sky = at.w < 1e-9L * label.e;
    at.past = at.slope > 0 && at.w >= 1.0L / hole.horizon();
    if (at.at_sky || at.past) break;
  }
  return at;
}

}  // namespace domefall
