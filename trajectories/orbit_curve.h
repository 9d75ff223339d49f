// An OrbitCurve is the radial motion of a timelike geodesic,
// (dr/dtau)^2 = E^2 - (1 - 2/r)(1 + L^2/r^2).  It runs along a parameter s that grows with proper
// time.  In s nothing is singular or cancels, neither at the turning points nor at the horizon, the
// singularity or infinity.  With w = 1/r the right side is the cubic
// P(w) = (E^2 - 1) + 2w - L^2 w^2 + 2 L^2 w^3 = 2 L^2 (w - w1)(w - w2)(w - w3).
//
//   scattered  r = r_p cosh^2 s                    from infinity to periastron at s = 0 and back
//   bound      r = r_p + (r_a - r_p) sin^2(s/2)    periastron at s = 0, apoastron at s = +-pi
//   returning  r = r_a / cosh^2 s                  singularity to singularity, apoastron at s = 0
//   plunging   r = r_c exp(-2s)                    from infinity to the future singularity
//   escaping   r = r_c exp(2s)                     from the past singularity to infinity
//
// What decides how long an orbit whirls is a difference of roots or the height over the barrier.
// It is a parameter of its own (`excess`), so that it can be given without cancellation.
#pragma once

namespace domefall {

struct OrbitConstants {
  double energy = 1;            // E >= 0
  double excess_energy = 0;     // E^2 - 1, which E alone cannot hold near 1
  double angular_momentum = 0;  // L >= 0
};

class OrbitCurve {
 public:
  enum class Kind { kScattered, kBound, kReturning, kPlunging, kEscaping };

  // Here excess is w3 - w2, and w1 <= 0 is the third root.
  static OrbitCurve scattered(const OrbitConstants& constants, double periastron, double w1,
                              double excess);
  static OrbitCurve bound(const OrbitConstants& constants, double periastron, double apoastron,
                          double excess);
  // With P = (w - w_a) G, excess is G(w_a) if r_a <= 6, and the least value of G if r_a > 6.
  static OrbitCurve returning(const OrbitConstants& constants, double apoastron,
                              double apoastron_over_two, double excess);
  // If L > 4, the barrier's top is at w_b, and excess = P(w_b).  If L <= 4, w_b is not used, and
  // excess is the least that 1 - L^2/16 may be.
  static OrbitCurve unturned(const OrbitConstants& constants, bool escaping, double w_b,
                             double excess);

  struct Point {
    double r, radial_speed, rate;  // dr/dtau, dtau/ds
  };
  Point at(double s) const;

  // Returns s at which r is passed on the way in or out, or NaN if that is never.  For bound orbits
  // it is in [-pi, pi].
  double parameter(double r, bool outward) const;

  Kind kind() const { return kind_; }
  const OrbitConstants& constants() const { return constants_; }
  double innermost() const;
  double outermost() const;
  // Returns the outermost radius - 2, exact where the radius is rounded.
  double outermost_over_two() const { return over_two_; }
  // These bound the part of the parameter that is tabulated, to r = kFarthest and kDeepest.
  double begin() const;
  double end() const;

  static constexpr double kFarthest = 1e30, kDeepest = 1e-16;  // M

 private:
  Point scattered_at(double s) const;
  Point bound_at(double s) const;
  Point returning_at(double s) const;
  Point unturned_at(double s) const;

  Kind kind_ = Kind::kBound;
  OrbitConstants constants_;
  double near_ = 0, far_ = 0;  // the turning radii; near_ is r_c of the unturned
  double over_two_ = 0;
  double w_ = 0;  // w1 of the scattered, w_m - w_a of the returning, 1/r_c of the unturned
  double excess_ = 0;
};

}  // namespace domefall
