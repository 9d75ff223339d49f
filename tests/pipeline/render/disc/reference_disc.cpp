#include "tests/pipeline/render/disc/reference_disc.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <stdexcept>

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

// Light that left gas nearer than this to the past horizon (M) is not looked for.  Its redshift is
// about the inverse, a million or more.
constexpr double kPastHorizon = 1e-6;

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 sum(const Vector3& a, double by, const Vector3& b) {
  return {a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]};
}

// ---- The ray ----

// A Light is the state of a ray: x, its rate of change back in time, and the change of v so far.
struct Light : std::array<double, 7> {
  Light() : std::array<double, 7>{} {}
  Vector3 place() const { return {(*this)[0], (*this)[1], (*this)[2]}; }
  Vector3 rate() const { return {(*this)[3], (*this)[4], (*this)[5]}; }
  double r() const { return std::sqrt(dot(place(), place())); }
  double outwards() const { return dot(place(), rate()) / r(); }  // -k^r
};

// Returns the wave vector, as frequency and frequency times direction of travel, in the frame of
// radial free fall.  The observer sees this light with frequency 1 from the direction m, so it is a
// Lorentz boost of (1, -m).
std::array<double, 4> boosted(const Vector3& celerity, const Vector3& m) {
  const double gamma = std::sqrt(1 + dot(celerity, celerity)), along = dot(celerity, m);
  std::array<double, 4> k{gamma - along, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    k[i + 1] = -m[i] - celerity[i] * along / (1 + gamma) + celerity[i];
  return k;
}

class IntegratedGeodesic {
 public:
  using Fehlberg78 =
      odeint::runge_kutta_fehlberg78<Light, double, Light, double, odeint::array_algebra>;

  IntegratedGeodesic(const ReferenceDiscView& view, const Vector3& direction) {
    const auto k = boosted(view.celerity, direction);
    const double s = std::sqrt(2 / view.r) * (view.outgoing ? -1 : 1);
    // The Killing vector is d/dt = T + s R, and E is its product with the wave vector.  The frame
    // itself moves by -s against spheres of constant r, which gives k^r.
    energy_ = k[0] - s * k[1];
    const double radial = k[1] - s * k[0];
    light_[0] = view.r;
    light_[3] = -radial, light_[4] = -k[2], light_[5] = -k[3];
    // The rate is back in time, but h^2 = L^2 has no sign.
    const Vector3 spin = cross(light_.place(), light_.rate());
    spin2_ = dot(spin, spin);
  }

  double energy() const { return energy_; }
  double momentum_about(const Vector3& axis) const {  // of the light, which goes the other way
    return -dot(cross(light_.place(), light_.rate()), axis);
  }
  const Light& light() const { return light_; }

  void operator()(const Light& y, Light& rate, double /*lambda*/) const {
    const double r = y.r(), pull = -3 * spin2_ / (r * r * r * r * r);
    for (std::size_t i = 0; i < 3; ++i) {
      rate[i] = y[i + 3];
      rate[i + 3] = pull * y[i];
    }
    // Along the light dv/dlambda = (E + k^r)/(1 - 2/r).  For light that falls this is 0/0 at r = 2,
    // so L^2/(r^2 (E - k^r)) is used, which is the same because E^2 - (k^r)^2 = (1 - 2/r) L^2/r^2.
    const double radial = -y.outwards();
    rate[6] =
        radial < 0 ? -spin2_ / (r * r * (energy_ - radial)) : -(energy_ + radial) / (1 - 2 / r);
  }

  // Goes back along the ray by one step, and returns the state before it.
  Light step() {
    const Light before = light_;
    // No step covers more than a part of the way to the hole's centre.  Light that moves outwards
    // came from the past horizon, where v = -infinity, so its steps cover a part of that way.
    const double speed = std::sqrt(dot(light_.rate(), light_.rate()));
    const double way = light_.outwards() < 0 ? light_.r() - 2 : light_.r();
    length_ = std::min(length_, 0.3 * way / speed);
    double lambda = 0;
    for (int tries = 0; tries < 100; ++tries) {
      if (stepper_.try_step(std::cref(*this), light_, lambda, length_) == odeint::success) {
        taken_ = lambda;
        return before;
      }
    }
    throw std::runtime_error("a ray beside the disc could not be followed");
  }
  // Returns the length of the last step in lambda.
  double taken() const { return taken_; }
  // Returns the state after one step of any length up to the last one's, which is as exact as that.
  Light after(const Light& start, double length) const {
    Fehlberg78 one;
    Light out;
    one.do_step(std::cref(*this), start, 0.0, out, length);
    return out;
  }

 private:
  using Stepper = odeint::controlled_runge_kutta<Fehlberg78>;
  static constexpr double kTolerance = 1e-14;

  Light light_;
  double energy_ = 0, spin2_ = 0, length_ = 1e-2, taken_ = 0;
  Stepper stepper_ = Stepper(Stepper::error_checker_type(kTolerance, kTolerance));
};

// Returns the state where the ray meets the plane between the two ends of a step, by bisection.  60
// halvings leave less than a double's last bit.
Light on_plane(const IntegratedGeodesic& ray, const Light& from, double length,
               const Vector3& normal) {
  double low = 0, high = length;
  const bool side = dot(ray.after(from, high).place(), normal) > 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    ((dot(ray.after(from, middle).place(), normal) > 0) == side ? high : low) = middle;
  }
  return ray.after(from, (low + high) / 2);
}

// ---- The gas ----

// Returns the flux from a face of the disc at r >= 6, up to a constant factor.  The gas radiates
// what it loses between r and the last stable orbit.  In [Page & Thorne 1974] that is the integral
// of (E - Omega L) dL/dr, here by quadrature, over r (E - Omega L)^2/|dOmega/dr|.  On circles
// E - Omega L = sqrt(1 - 3/r) and L = r/sqrt(r - 3), so the integrand is
// (r - 6)/(2 sqrt(r) (r - 3)).  With Omega = r^(-3/2) the divisor is proportional to
// (r - 3) r^(5/2).
//
// The pull of plunging gas adds a constant (disc_light.h): 0.02 of the angular momentum sqrt(12)
// of the last stable orbit, times E - Omega L = sqrt(1/2) there.
double flux(double r, bool plunging) {
  const auto lost = [](double x) { return (x - 6) / (2 * std::sqrt(x) * (x - 3)); };
  const double brought =
      r > 6 ? boost::math::quadrature::gauss_kronrod<double, 31>::integrate(lost, 6, r, 12, 1e-13)
            : 0;
  return (brought + (plunging ? 0.02 * std::sqrt(6.0) : 0)) / ((r - 3) * std::pow(r, 2.5));
}

// Returns the largest flux at r >= 6.  It lies at 9.55, where a search by thirds finds it, or at 6
// if gas plunges.
double greatest_flux(bool plunging) {
  if (plunging) return flux(6, true);
  // The flux has a single maximum between these bounds.  100 steps leave (2/3)^100 = 2e-18 of their
  // distance.
  double low = 8, high = 12;
  for (int k = 0; k < 100; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (flux(a, false) < flux(b, false) ? low : high) = flux(a, false) < flux(b, false) ? a : b;
  }
  return flux((low + high) / 2, false);
}

// Flux goes like the fourth power of temperature.  Below 6 the plunging gas expands by the law of
// [Mummery & Balbus 2023], as in disc_light.h.
double temperature(double r, bool plunging) {
  static const double greatest[] = {greatest_flux(false), greatest_flux(true)};
  if (r >= 6) return std::pow(flux(r, plunging) / greatest[plunging ? 1 : 0], 0.25);
  if (!plunging) return 0;
  return std::pow(6 / r, 17.0 / 28) * std::pow(1 + std::pow(6 / r - 1, 1.5) / 0.01, -1.0 / 28);
}

// Returns 1 + z = u.k for gas on a circle, Omega = r^(-3/2), u^t = 1/sqrt(1 - 3/r).  Plunging gas
// keeps the energy sqrt(8/9) and the angular momentum sqrt 12 of the last stable orbit.  Its u^r
// follows from u.u = 1, and with f = 1 - 2/r the product is (E_gas E - u^r k^r)/f - L_gas L/r^2.
double shift(const IntegratedGeodesic& ray, const Light& at, const Vector3& axis) {
  const double r = at.r(), turned = ray.momentum_about(axis);
  if (r >= 6) return (ray.energy() - turned / std::pow(r, 1.5)) / std::sqrt(1 - 3 / r);
  const double own = std::sqrt(8.0 / 9), f = 1 - 2 / r;
  const double fall = -std::sqrt(std::max(0.0, 8.0 / 9 - f * (1 + 12 / (r * r))));
  return (own * ray.energy() + fall * at.outwards()) / f - std::sqrt(12.0) * turned / (r * r);
}

// Returns the azimuth (radians) of a place in the plane, from the part of R in the plane or, where
// R is the normal, from Theta's.
double azimuth_of(const Vector3& place, const Vector3& normal) {
  Vector3 first = sum({1, 0, 0}, -normal[0], normal);
  if (dot(first, first) < 1e-20) first = sum({0, 1, 0}, -normal[1], normal);
  return std::atan2(dot(cross(normal, first), place), dot(first, place));
}

}  // namespace

std::vector<ReferenceDiscPlace> reference_disc(const ReferenceDiscView& view,
                                               const Vector3& direction, int orders) {
  IntegratedGeodesic ray(view, direction);
  std::vector<ReferenceDiscPlace> found;
  // Light with E < 0 comes from region III.  An observer before the past horizon sees region IV
  // alone.
  if (!(ray.energy() > 0) || (view.outgoing && view.r <= 2)) return found;
  // An observer in the plane counts as being on the side to which the ray leads.
  double before_side = dot(ray.light().place(), view.normal);
  if (before_side == 0) before_side = dot(ray.light().rate(), view.normal);
  for (int order = 0; order < orders;) {
    const Light before = ray.step();
    const Light& now = ray.light();
    const double side = dot(now.place(), view.normal);
    if (side * before_side < 0) {
      const Light at = on_plane(ray, before, ray.taken(), view.normal);
      const double r = at.r();
      if (r > 2 && r >= view.inner && r <= view.outer) {
        // The gas has t = v - r*, and at[6] is v there less the observer's v, which is u + 2 r* of
        // the observer.
        const double tortoise = r + 2 * std::log(r / 2 - 1);
        const double own = view.r + 2 * std::log(view.r / 2 - 1);
        found.push_back({order, r, azimuth_of(at.place(), view.normal), shift(ray, at, view.normal),
                         temperature(r, view.plunging),
                         tortoise - at[6] - (view.outgoing ? 2 * own : 0)});
      }
      ++order;
    }
    before_side = side;
    // The ray has come to the past horizon, or it leads to the sky and is beyond the disc.
    if (now.outwards() < 0 && now.r() < 2 + kPastHorizon) break;
    if (now.outwards() > 0 && now.r() > 3 && now.r() > view.outer) break;
  }
  return found;
}

}  // namespace domefall
