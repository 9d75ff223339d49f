#include "pipeline/light/silhouette.h"

#include <cmath>

#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// These are what both roots are made of, in double or, where an angle is to be measured from an
// edge, in more digits.
template <class Real>
struct Parts {
  Real r, above_horizon, root27, s;
  Real signed_root;  // (r - 3) sqrt(1 + 6/r): of r^2 - 27 (1 - 2/r), with the sign of r - 3

  explicit Parts(const Radius& at)
      : r(r_as<Real>(at)),
        above_horizon(above_horizon_as<Real>(at)),
        root27(std::sqrt(Real{27})),
        s(Schwarzschild::free_fall_speed(r)),
        signed_root(above_light_circle_as<Real>(at) * std::sqrt(1 + 6 / r)) {}

  // Returns a root as the quotient without cancellation, by the sum, or by the product over the
  // other.
  Real by_sum(Real root) const { return (r + root) / (root27 * (1 + s)); }
  Real by_product(Real root) const { return root27 * (above_horizon / (r * (1 + s))) / (r + root); }
};

template <class Real>
Real silhouette_root(const Radius& at) {
  const Parts<Real> p(at);
  return at.r > 3 ? p.by_product(p.signed_root) : p.by_sum(-p.signed_root);
}

template <class Real>
Real other_root(const Radius& at) {
  const Parts<Real> p(at);
  return at.r < 3 ? p.by_product(-p.signed_root) : p.by_sum(p.signed_root);
}

}  // namespace

double tan_half_silhouette(const Radius& at) {
  return std::isinf(at.r) ? 0 : silhouette_root<double>(at);
}

long double tan_half_silhouette_long(const Radius& at) { return silhouette_root<long double>(at); }

long double tan_half_other_root_long(const Radius& at) { return other_root<long double>(at); }

double tan_half_region_three(const Radius& at) { return -tan_half_other_root(at); }

double tan_half_other_root(const Radius& at) { return other_root<double>(at); }

double silhouette_edge(const Radius& at) { return 2 * std::atan(tan_half_silhouette(at)); }

double region_three_edge(const Radius& at) { return 2 * std::atan(tan_half_region_three(at)); }

}  // namespace domefall
