// A ChargedView is what an observer near a charge sees of light: where a ray comes from, and the
// azimuth that it sweeps on its way.
//
//     phi = int dw / sqrt(P),   P(w) = 1/b^2 - w^2 + 2 w^3 - q^2 w^4,   w = 1/r.
//
// The observer is the tetrad T (spacetime/charged.h), or the outgoing one, T'.  In T alpha = delta,
// the angle from -R, the direction of the hole, and
//     E = sin^2(alpha/2) + f cos^2(alpha/2),  L = r sin(alpha),  k^r = f cos^2 - sin^2.
// In T' alpha = pi - delta, the angle from +R.  Time reversal makes the two one: E and L are the
// same functions, and k^r has the opposite sign.
//
// A ray carries its distances from the critical rays, b = +-kappa, as NullRay does.  From them
// follows eps = 1/b^2 - 1/kappa^2 as a product, and P is factorised from it (orbit_quartic.h).  The
// integral over a quartic is that of Carlson, Math. Comp. 51 (1988) 267.
#pragma once

#include "pipeline/light/null_ray.h"
#include "pipeline/light/orbit_quartic.h"
#include "pipeline/spacetime/charged.h"

namespace domefall {

// A ChargedOrigin is where light started.  The universes of a charged hole follow each other: what
// falls in may come out in the next, and light of the one before may arrive with it.
enum class ChargedOrigin : char {
  kOwn,             // the sky of the exterior that the observer's tetrad belongs to
  kParallel,        // that of the other exterior of the same universe
  kBefore,          // those of the universe before, whose light went through the inside
  kParallelBefore,  //
  kDark             // nowhere: it has circled, or gone to and fro within, for ever
};

struct ChargedRay {
  long double sin_half, cos_half;  // of alpha/2, alpha in [0, pi]
  // sin(alpha/2) - |tan| cos(alpha/2) of each critical ray, with full relative accuracy.  Where
  // there is none, only the first two numbers count.
  long double gap_first, gap_second;
};

class ChargedView {
 public:
  // The place must be finite, 0 < r, and not on an inner horizon.
  ChargedView(const ChargedHole& hole, const ChargedRadius& at, bool outgoing = false);

  // Says whether there are rays of |b| = kappa at this place: not below r_x, nor for q^2 > 9/8.
  bool has_edges() const { return circle_.exists && edges_.real; }
  // Returns tan(alpha/2) of one.  kSecond is that of -kappa between the horizons.
  long double tan_half_critical(Critical edge) const;

  // Returns the angle between the two, in alpha, or between the complex ones below r_x.  Light must
  // be able to circle.
  long double between_edges() const;

  ChargedRay ray_at(const PolarAngle& alpha) const;
  // Returns the ray at alpha = edge + offset in [0, pi].  The offset has full relative accuracy.
  ChargedRay ray_off_edge(Critical edge, double offset) const;

  ChargedOrigin origin_of(const ChargedRay& ray) const;
  // Returns the azimuth in radians, >= 0.  It is 0 for a radial ray, and infinite for one that
  // comes from nowhere.
  double azimuth(const ChargedRay& ray) const;
  // Returns E, signed, whose absolute value is 1 + z for T (T') itself.
  long double energy(const ChargedRay& ray) const;

  const ChargedHole& hole() const { return hole_; }
  const ChargedRadius& at() const { return at_; }
  bool outgoing() const { return outgoing_; }
  long double lapse_squared() const { return f_; }
  // What the orbits of this charge have in common.  Each passage of the circle adds
  // -ln|offset|/sqrt(circle().second) to an azimuth.
  const LightCircle& circle() const { return circle_; }

 private:
  ChargedRay completed(long double sine, long double cosine, long double gap, Critical edge) const;
  long double tangents_apart() const;
  long double radial(const ChargedRay& ray) const;  // k^r
  // Returns E^2 - L^2/kappa^2, or E^2 where light cannot circle.
  long double below_critical(const ChargedRay& ray) const;

  ChargedHole hole_;
  ChargedRadius at_;
  bool outgoing_;
  LightCircle circle_;
  long double f_, inverse_kappa_ = 0;
  ChargedHole::CriticalTangents edges_{};
};

}  // namespace domefall
