#include "pipeline/report/reference/reference_ray.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <stdexcept>

namespace domefall {
namespace {

using boost::math::ellint_rf;

Wide wide_pi() { return boost::math::constants::pi<Wide>(); }
Wide square(const Wide& x) { return x * x; }

using Invariants = ReferenceInvariants;

// Returns E, L and k^r by the table in the header.
Invariants plain_invariants(ReferenceObserver observer, const Wide& r, const Wide& delta) {
  const Wide c = cos(delta), l = r * sin(delta), s = sqrt(2 / r);
  const Wide at_rest = sqrt(abs(1 - 2 / r));
  switch (observer) {
    case ReferenceObserver::kStatic:
      return {at_rest, l, at_rest * c};
    case ReferenceObserver::kOutgoing:
      return {1 + s * c, l, c + s};
    case ReferenceObserver::kTwo:
      return {-at_rest * c, l, -at_rest};
    case ReferenceObserver::kFour:
      return {-at_rest * c, l, at_rest};
    case ReferenceObserver::kRain:
      break;
  }
  return {1 - s * c, l, c - s};
}

// ---- Where the ray came from ----

enum class OrbitPath { kFromSky, kFromSkyTurning, kFromSingularity, kFromSingularityTurning };

struct Course {
  ReferenceOrigin origin;
  OrbitPath path;
};

// Followed back in time, a ray with b < b_c = sqrt 27 passes the light circle at r = 3, and one
// with b > b_c is turned back by it.  So the origin depends on b and, outside the horizon, also on
// the side of the circle and on the sign of k^r.
Course course_of(ReferenceObserver observer, const Wide& r, const Invariants& k) {
  using enum ReferenceOrigin;
  // From region IV a ray can only lead back to the singularity that it left.
  const bool white_hole =
      observer == ReferenceObserver::kFour || (observer == ReferenceObserver::kOutgoing && r <= 2);
  if (white_hole) return {kPastSingularity, OrbitPath::kFromSingularity};
  const bool captured = square(k.angular_momentum) < 27 * square(k.energy);  // b < b_c
  if (r <= 2) {
    if (!captured) return {kPastSingularity, OrbitPath::kFromSingularityTurning};
    return {k.energy > 0 ? kSkyOne : kSkyThree, OrbitPath::kFromSky};
  }
  // k^r < 0 is light that falls, so back in time it leads outwards.
  if (k.radial < 0) {
    if (captured || r > 3) return {kSkyOne, OrbitPath::kFromSky};
    return {kPastSingularity, OrbitPath::kFromSingularityTurning};
  }
  if (r > 3 && !captured) return {kSkyOne, OrbitPath::kFromSkyTurning};
  return {kPastSingularity, OrbitPath::kFromSingularity};
}

// ---- The azimuth ----

// Returns Legendre's F(psi, k) for 0 <= psi <= pi/2, by DLMF 19.25.5.  With c = 1/sin^2(psi) that
// is R_F(c - 1, c - k^2, c), and R_F is homogeneous of degree -1/2.
Wide legendre_f(const Wide& sin2_psi, const Wide& k2) {
  return sqrt(sin2_psi) * ellint_rf(Wide(1 - sin2_psi), Wide(1 - k2 * sin2_psi), Wide(1));
}

// OneRealRoot is the integral of dw/sqrt(P) from a, where P = 2 (w - a)((w - m)^2 + n^2), by Byrd
// and Friedman 239.00.  Twice the sum of the roots is 1, and twice their product is -1/b^2.  So m
// and n follow from a.
class OneRealRoot {
 public:
  OneRealRoot(const Wide& inverse_b2, const Wide& a) : a_(a) {
    const Wide m = (Wide(1) / 2 - a) / 2;         // by the sum of the roots
    const Wide modulus2 = -inverse_b2 / (2 * a);  // m^2 + n^2, by their product
    far_ = sqrt(square(a - m) + modulus2 - square(m));
    k2_ = (far_ + m - a) / (2 * far_);
    scale_ = 1 / sqrt(2 * far_);
  }
  Wide to(const Wide& w) const {
    const Wide cosine = (far_ - (w - a_)) / (far_ + (w - a_));
    const Wide f = legendre_f(1 - square(cosine), k2_);
    return scale_ * (cosine >= 0 ? f : 2 * legendre_f(1, k2_) - f);
  }
  Wide to_infinity() const { return scale_ * 2 * legendre_f(1, k2_); }

 private:
  Wide a_, far_, k2_, scale_;
};

// ThreeRealRoots is the integral of dw/sqrt(P) where P = 2 (w - w1)(w - w2)(w - w3), with the roots
// in descending order.  A ray from a sky turns at w2, and one from the singularity at w1.
struct ThreeRealRoots {
  Wide w1, w2, w3;

  // Returns the integral from w3 to w <= w2, by the substitution w = w3 + (w2 - w3) sin^2 psi.
  Wide below(const Wide& w) const {
    return sqrt(2 / (w1 - w3)) * legendre_f((w - w3) / (w2 - w3), (w2 - w3) / (w1 - w3));
  }
  // Returns the integral from w >= w1 to infinity, which is the definition of R_F.
  Wide above(const Wide& w) const {
    return sqrt(Wide(2)) * ellint_rf(Wide(w - w1), Wide(w - w2), Wide(w - w3));
  }
  Wide swept(const Wide& w, OrbitPath path) const {
    switch (path) {
      case OrbitPath::kFromSky:
        return below(w) - below(0);
      case OrbitPath::kFromSkyTurning:
        return 2 * below(w2) - below(w) - below(0);
      case OrbitPath::kFromSingularityTurning:
        return 2 * above(w1) - above(w);
      case OrbitPath::kFromSingularity:
        break;
    }
    return above(w);
  }
};

// With w = t/3 + 1/6, P = 0 becomes 4 t^3 - 3 t = 1 - 54/b^2.  If b > b_c, its roots are cosines,
// since cos(3 psi) = 4 cos^3(psi) - 3 cos(psi).  Otherwise its only real root is minus a hyperbolic
// cosine, which obeys the same identity.
Wide swept_azimuth(const Invariants& k, const Wide& r, OrbitPath path) {
  if (k.angular_momentum == 0) return 0;
  const Wide inverse_b2 = square(k.energy / k.angular_momentum), w = 1 / r;
  const Wide q = 1 - 54 * inverse_b2;
  const auto root = [](const Wide& t) -> Wide { return t / 3 + Wide(1) / 6; };
  if (q >= -1) {
    const Wide psi = acos(q) / 3, third = 2 * wide_pi() / 3;
    return ThreeRealRoots{root(cos(psi)), root(cos(psi - third)), root(cos(psi + third))}.swept(
        w, path);
  }
  const OneRealRoot g(inverse_b2, root(-cosh(acosh(Wide(-q)) / 3)));
  return path == OrbitPath::kFromSky ? g.to(w) - g.to(0) : g.to_infinity() - g.to(w);
}

// The azimuth is odd about the axis, as L is, so delta may run over both ends of [0, pi].
Wide signed_azimuth(ReferenceObserver observer, const Wide& r, const Wide& delta, OrbitPath path) {
  const Invariants k = plain_invariants(observer, r, delta);
  const Wide swept = swept_azimuth(k, r, path);
  return k.angular_momentum < 0 ? -swept : swept;
}

// The edges of rain are given by tan(delta/2) = numerator/(sqrt 27 (1 + sqrt(2/r))).
Wide half_angle_edge(const Wide& numerator, const Wide& r) {
  return 2 * atan(numerator / (sqrt(Wide(27)) * (1 + sqrt(2 / r))));
}

// Throws unless there is such an observer at r.
void check_radius(ReferenceObserver observer, const Wide& r) {
  const bool inside = observer == ReferenceObserver::kTwo || observer == ReferenceObserver::kFour;
  if (r <= 0 || (inside && r >= 2) || (observer == ReferenceObserver::kStatic && r <= 2))
    throw std::domain_error("reference_ray: no such observer at this r");
}

Wide delta_of(const ReferenceRequest& q) {
  return q.edge ? reference_edge(q.observer, q.r, *q.edge) + q.offset : q.delta;
}

}  // namespace

Wide reference_edge(ReferenceObserver observer, const Wide& r, ReferenceEdge edge) {
  check_radius(observer, r);
  const bool third = edge == ReferenceEdge::kRegionThree;
  // Its square is r^2 - 27 (1 - 2/r), the discriminant of [Riazuelo] eq. tan_delta.
  const Wide reach = (r - 3) * sqrt(1 + 6 / r);
  switch (observer) {
    case ReferenceObserver::kRain:
      if (third && r > 2) break;
      return third ? half_angle_edge(-r - reach, r) : half_angle_edge(r - reach, r);
    case ReferenceObserver::kOutgoing:  // the formula holds for pi - delta, with the other root
      if (third || r <= 2) break;
      return wide_pi() - half_angle_edge(r + reach, r);
    case ReferenceObserver::kStatic:
      if (third) break;
      // L = sqrt(27) E gives sin(delta) = sqrt(27 (1 - 2/r))/r, and 1 - sin^2 is (reach/r)^2.
      return atan2(sqrt(27 * (1 - 2 / r)), reach);
    // L/|E| = r |tan(delta)|/sqrt(2/r - 1), which is sqrt(27) on both sides of pi/2.
    case ReferenceObserver::kTwo: {
      const Wide angle = atan(sqrt(27 * (2 / r - 1)) / r);
      return third ? angle : wide_pi() - angle;
    }
    case ReferenceObserver::kFour:
      break;
  }
  throw std::domain_error("reference_ray: no such edge for this observer");
}

ReferenceInvariants reference_invariants(const ReferenceRequest& q) {
  return plain_invariants(q.observer, q.r, delta_of(q));
}

ReferenceRay reference_ray(const ReferenceRequest& q) {
  check_radius(q.observer, q.r);
  const Wide delta = delta_of(q);
  const Invariants k = plain_invariants(q.observer, q.r, delta);
  const Course course = course_of(q.observer, q.r, k);
  const auto phi = [&](const Wide& at) { return signed_azimuth(q.observer, q.r, at, course.path); };
  // Of 100 digits a difference of this step leaves 60, and its truncation is 1e-80.
  const Wide h("1e-40");
  const Wide slope = (phi(delta + h) - phi(delta - h)) / (2 * h);
  const Wide swept = phi(delta);
  // On the axis sin(delta)/sin(phi) is 0/0, and tends to 1/slope in absolute value.
  const bool far_end = swept == 0;
  const Wide amplification = far_end ? 1 / square(slope) : abs(sin(delta) / (sin(swept) * slope));
  return {delta, course.origin, swept, abs(k.energy), slope, amplification};
}

}  // namespace domefall
