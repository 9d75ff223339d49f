// How a ray starts from an observer near a spinning hole, who moves as the tetrad T: with n = -d/dr and
// l = [(r^2 + a^2) d/dv + a d/dphi + (Delta/2) d/dr]/Sigma, in the coordinates of light that falls,
// T = l + n/2 and R = l - n/2, beside Theta and Phi.  The photon is
//
//     k = T + cos(delta) R + sin(delta) (cos(eta) Theta + sin(eta) Phi)
//
// and the look direction is minus that, so that delta is the angle from -R, the direction of the hole.
//
// A ray is known by E and, over E, kappa = sqrt(K)/E and mu = aY/E, with Y = L - aE sin^2(theta).  Light
// of E < 0 is the mirror image, in the plane phi = 0, of light of E > 0 with -eta, and its constants
// here are the mirror image's.
#pragma once

#include <optional>

#include "pipeline/spacetime/kerr.h"

namespace domefall {

struct KerrPlace {
  KerrHole hole;
  long double r = 0, theta = 0;  // r > r_-

  long double delta() const { return hole.delta(r); }
  // Returns a^2 cos^2(theta).
  long double sigma() const;
  bool operator==(const KerrPlace&) const = default;
};

// Skies of r = infinity and what is black: I, III and H.
enum class KerrOrigin { kOwn, kParallel, kPastHorizon };

enum class KerrEdge { kSilhouette, kRegionThree };

// A KerrDirection gives delta, or how far it is from an edge at the same eta, to full accuracy.
struct KerrDirection {
  long double delta = 0, eta = 0;
  std::optional<KerrEdge> edge{};
  long double offset = 0;
};

// A CriticalRay is the one at an angle eta that winds up to light that circles at r = x.
struct CriticalRay {
  long double x, above_one;  // x - 1
  long double root;          // sqrt Delta(x)
  long double kappa;
  long double curvature;  // half of d^2/dr^2 of (r'/E)^2 at x
  long double rho;        // of the observer: r - x
  long double far;        // X: (r'/E)^2 = X^2 at the observer, of the sign of rho
  long double tau;        // sqrt Sigma tan(delta/2)
  long double delta;
};
// Returns the edge, which of region III is one of light of E < 0.
CriticalRay critical_ray(const KerrPlace& at, long double eta, KerrEdge edge);

// A Scaled is what changes with delta, and with eta, here by sin(delta) d eta.
struct Scaled {
  long double v = 0, by_delta = 0, by_eta = 0;
};

struct KerrStart {
  KerrPlace at;
  KerrOrigin origin;
  bool mirrored;                    // E < 0
  long double energy;               // signed; |E| is emitted / observed frequency
  long double sine, cosine, sigma;  // of theta, and a^2 cos^2(theta)
  CriticalRay edge;                 // the nearest, of the same sign of E
  long double side;                 // s_1 = a sin(theta) sin(eta), mirrored
  long double kappa_less_edge;
  Scaled kappa, mu;
  Scaled speed;             // r'/|E|, of the photon
  Scaled polar, azimuthal;  // N'(0)/|E|, of the photon, mirrored
};
KerrStart kerr_start(const KerrPlace& at, const KerrDirection& direction);

}  // namespace domefall
