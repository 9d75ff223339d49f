// A LightPath is the way of one ray past places near the hole, followed back in time from the
// observer, for matter that glows all along it.
//
// With w = 1/r and the swept angle psi, light obeys w'' = -w + 3 w^2 - 2 q^2 w^3 near a hole of charge
// q (M = 1), and w'' = -w if it goes straight.  About a hole that spins, w and the unit vector N obey
// by Mino's time, with G = (E + c w^2)^2 - K w^2 (1 - 2w + s w^2), c = a^2 E - a L, s = a^2 + q^2,
//
//     w'' = G'(w)/2,    N'' = -(K + 2aEL - a^2 E^2 + 2 a^2 E^2 N_z^2) N + a^2 E^2 N_z z,
//
// and the plane of N turns about z by psi' = -aE + aA (kerr_path.h).  This is integrated in steps of
// fourth order, which are short where r changes fast.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "pipeline/light/kerr_start.h"
#include "pipeline/light/plane_images.h"
#include "trajectories/directions.h"

namespace domefall {

// A GasView is from where one observer sees what is all around the hole.
struct GasView {
  PlaneView view;
  // The angle alpha of light_path() at which light winds around the hole, if light is bent.
  std::optional<double> edge;
  // About a hole that spins this is where the observer is, and the edge is one for each azimuth: that
  // of the plane in which n leads away from the axis R.
  std::optional<KerrPlace> spinning{};
  std::function<double(double)> edge_at{};

  double edge_of(double azimuth) const { return edge_at ? edge_at(azimuth) : edge.value_or(0); }
};

struct LightPath {
  // E and L of light that is one in the frame of the view, or the root of K about a spin.
  // Without one, light of region I has E > 0.
  double energy = 0, momentum = 0;
  // L about the axis n is n.about.
  V3d about{0, 0, 0};
  // By how much psi grows with Mino's time, in which light of frequency 1 goes r^2 M.
  double rate = 1;
  struct Place {
    double psi, w, slope;  // radians, 1/M, dw/dpsi
    V3d at, turning;       // unit, from the hole, and its derivative by psi
    // v of the place less that of the observer, M; u in the outgoing frame.  Straight light has 0.
    double time;
  };
  // From the observer on, as far as the path lies between the radii.  A place in the hole is where
  // the path of an observer in region II begins.
  std::vector<Place> places;

  // Returns 1/r, its slope and the direction between two successive places, by the cubics through them;
  // `part` is 0 to 1.
  static double inverse_radius(const Place& a, const Place& b, double part) {
    const double h = b.psi - a.psi, t = part, s = 1 - part;
    return s * s * ((1 + 2 * t) * a.w + t * h * a.slope) +
           t * t * ((1 + 2 * s) * b.w - s * h * b.slope);
  }
  static double slope(const Place& a, const Place& b, double part) {
    const double h = b.psi - a.psi, t = part, s = 1 - part;
    return 6 * s * t * (b.w - a.w) / h + s * (s - 2 * t) * a.slope + t * (t - 2 * s) * b.slope;
  }
  static V3d direction(const Place& a, const Place& b, double part) {
    const double h = b.psi - a.psi, t = part, s = 1 - part;
    return a.at * (s * s * (1 + 2 * t)) + a.turning * (s * s * t * h) +
           b.at * (t * t * (1 + 2 * s)) - b.turning * (t * t * s * h);
  }
};

// Finds the path of the ray at 0 < alpha < pi (radians) from -R, or from R in an outgoing frame,
// down to the horizon and up to r = `outer`, and no farther than 7/2 half turns.  It has no places
// where no light of region I comes that way, and none where it only leads away from the radii.  Its
// directions are along R, along `across`, to the side of which the ray leads away, and across both.
// Measured against RayOrbits at r from 0.5 to 100, w is within 1e-5 e^psi, and the time within 0.05 M.
LightPath light_path(const PlaneView& view, double alpha, double outer);

// Finds that of a ray about a hole that spins, with directions along R, Theta and Phi.  Psi grows by pi
// from one crossing of the equator to the next.  Towards the past horizon the path ends where Delta is
// 1e-4 r^2.
LightPath kerr_light_path(const KerrPlace& at, double delta, double eta, double outer);

}  // namespace domefall
