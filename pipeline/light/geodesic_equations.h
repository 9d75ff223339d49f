// The geodesic equation of light in the plane of the ray is held here as two second-order sets (M =
// 1).  The parameter runs backward in time, so velocities are -k, but the equations are quadratic
// in them and stay the same.  The motion is planar, so the plane is the equator, with theta = pi/2
// throughout.
//
// In Schwarzschild's coordinates, [Riazuelo] eq. deb_ode1 to fin_ode1, y = (t, r, phi, t', r',
// phi') and A = 1 - 2/r:
//   t'' = -(A_r/A) t' r'
//   r'' = -(A A_r/2) t'^2 + (A_r/2A) r'^2 + A r phi'^2
//   phi'' = -(2/r) r' phi'
//
// In Kruskal's, [Riazuelo] sec. ssec_max, y = (U, V, phi, U', V', phi').  With U V = -(r/2 - 1)
// exp(r/2) put in, nothing is left that divides by U, V or A:
//   r_U = -4 V exp(-r/2)/r    r_V = -4 U exp(-r/2)/r    F = g_UV = 16 exp(-r/2)/r
//   U'' = (1/2 + 1/r) r_U U'^2 + (r U/4) phi'^2
//   V'' = (1/2 + 1/r) r_V V'^2 + (r V/4) phi'^2
//   phi'' = -(2/r) (r_U U' + r_V V') phi'
// The term in phi'^2 of U'' is -(r/F) r_V phi'^2.  The paper's text has r_U and r_V swapped in it.
//
// Outside its chart (r <= 0, U V > 1, or the other side of r = 2 in Schwarzschild's coordinates) a
// right-hand side is NaN, which a step control refuses.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "pipeline/spacetime/kruskal.h"

namespace domefall {

enum class Chart { kSchwarzschild, kKruskal };

using RayState = std::array<double, 6>;

// Both charts have the azimuth and its derivative at these indices.
inline constexpr int kAzimuth = 2, kAzimuthRate = 5;

struct GeodesicEquations {
  Chart chart = Chart::kSchwarzschild;
  bool outside = true;  // r > 2; Schwarzschild only
  long* evaluations = nullptr;

  void operator()(const RayState& y, RayState& dy, double /*parameter*/) const {
    ++*evaluations;
    dy = chart == Chart::kSchwarzschild ? schwarzschild(y) : kruskal(y);
  }

  bool holds(const RayState& y) const {
    if (chart == Chart::kSchwarzschild) return y[1] > 0 && (y[1] > 2) == outside;
    return y[0] * y[1] < 1;
  }

  // Returns what the error of each component is measured against.  Positions count by their size
  // and the step's own share.  U', V' and phi' count by their size, which is the same to every
  // boost.  t is ignorable, so its error counts nowhere.  r' counts against the conserved energy
  // too, as it vanishes at a turning point.
  RayState scale(const RayState& y, const RayState& dy, double h) const {
    RayState s;
    for (int i = 0; i < 6; ++i) s[i] = std::abs(y[i]) + std::abs(h * dy[i]);
    if (chart == Chart::kSchwarzschild) {
      s[0] = std::numeric_limits<double>::max();
      s[4] = std::abs(y[4]) + std::abs((1 - 2 / y[1]) * y[3]);
    }
    return s;
  }

 private:
  RayState refused() const {
    RayState dy;
    dy.fill(std::numeric_limits<double>::quiet_NaN());
    return dy;
  }

  RayState schwarzschild(const RayState& y) const {
    if (!holds(y)) return refused();
    const double r = y[1], t1 = y[3], r1 = y[4], phi1 = y[5];
    const double a = 1 - 2 / r, a_r = 2 / (r * r);
    return {t1,
            r1,
            phi1,
            -(a_r / a) * t1 * r1,
            -0.5 * a * a_r * t1 * t1 + 0.5 * (a_r / a) * r1 * r1 + a * r * phi1 * phi1,
            -(2 / r) * r1 * phi1};
  }

  RayState kruskal(const RayState& y) const {
    if (!holds(y)) return refused();
    const double r = 2 + radius_less_two(y[0] * y[1]), u1 = y[3], v1 = y[4], phi1 = y[5];
    const double common = -4 * std::exp(-r / 2) / r, centrifugal = r / 4 * phi1 * phi1;
    const double r_u = common * y[1], r_v = common * y[0], f = 0.5 + 1 / r;
    return {u1,
            v1,
            phi1,
            f * r_u * u1 * u1 + centrifugal * y[0],
            f * r_v * v1 * v1 + centrifugal * y[1],
            -(2 / r) * (r_u * u1 + r_v * v1) * phi1};
  }
};

}  // namespace domefall
