#include "pipeline/optics/ray_position.h"

#include <algorithm>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/orbit_cubic.h"

namespace domefall {
namespace {

// A place on the orbit: w, and sqrt(P) = |dw/dpsi|.
struct OrbitPlace {
  double w, speed;
};

// sigma from the singularity, up to half of the orbit's period.
OrbitPlace from_singularity_three_roots(const Cubic& c, double sigma) {
  const RealRoots w = real_roots(c);
  const double span = w.w1 - w.w3;
  const double modulus = std::sqrt(std::min(1.0, (w.w2 - w.w3) / span));
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(modulus, sigma * std::sqrt(span / 2), &cn, &dn);
  // The distances of w from w3, w1 and w2 are span/sn^2 times 1, cn^2 and dn^2.
  const double scale = span / (sn * sn);
  return {w.w3 + scale, std::sqrt(2 * scale) * scale * std::abs(cn * dn)};
}

OrbitPlace from_singularity_one_root(const Cubic& c, double sigma) {
  const OneRealRoot p = one_real_root(c.eps);
  const double height = std::hypot(p.root - p.m, p.n);
  const double square = 0.5 - 0.75 * (p.root + 1.0 / 6) / height;
  const double modulus = std::sqrt(std::min(1.0, square));
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(modulus, sigma * std::sqrt(2 * height), &cn, &dn);
  // (1 + cn)/(1 - cn), from whichever of the two does not cancel.
  const double ratio = cn >= 0 ? (1 + cn) / sn * ((1 + cn) / sn) : sn / (1 - cn) * (sn / (1 - cn));
  const double above_root = height * ratio, x = p.root + above_root;
  return {1.0 / 3 + x, std::sqrt(2 * above_root) * std::hypot(x - p.m, p.n)};
}

OrbitPlace from_singularity(const Cubic& c, double sigma) {
  return c.eps < 0 ? from_singularity_three_roots(c, sigma) : from_singularity_one_root(c, sigma);
}

double radius_from_sky(const Cubic& c, double rho) {
  const double e = std::sqrt(c.inverse_b2);
  const OrbitPlace s = from_singularity(c, rho);
  return s.w / e * (s.w / (e + s.speed));
}

// A ray so near to the axis that its orbit is straight wherever r is a number of use.
std::optional<double> nearly_radial_position(const NullRay& ray, const RayInvariants& k,
                                             double psi) {
  if (psi >= exact_azimuth(ray)) return std::nullopt;
  return 1 / (1 / ray.at.r + k.radial / k.angular_momentum * psi);
}

}  // namespace

std::optional<double> exact_position(const NullRay& ray, double psi) {
  if (psi == 0) return ray.at.r;
  const RayInvariants k = invariants(ray);
  if (k.angular_momentum == 0) return std::nullopt;
  if (is_nearly_radial(k)) return nearly_radial_position(ray, k, psi);
  const Cubic c = cubic_of(ray.at, k);
  if (c.eps == 0 && c.x == 0) return ray.at.r;  // on the light circle itself
  const double left = exact_azimuth(ray) - psi;
  if (!(left > 0)) return std::nullopt;
  const EndAzimuths ends = end_azimuths(c);
  const bool inwards = k.radial > 0;  // back in time
  if (c.eps < 0) {
    const bool from_sky = c.x < 0;
    const double passed = (from_sky ? ends.sky : ends.singularity) + psi;
    // A path that turns is the same on both sides of the turning point.
    const double from_end = inwards == from_sky ? std::min(passed, left) : left;
    return from_sky ? radius_from_sky(c, from_end) : 1 / from_singularity(c, from_end).w;
  }
  const double rho = inwards ? ends.sky + psi : left;
  const double sigma = inwards ? left : ends.singularity + psi;
  return rho < sigma ? radius_from_sky(c, rho) : 1 / from_singularity(c, sigma).w;
}

}  // namespace domefall
