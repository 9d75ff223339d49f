// A ray by its orbit's own equation, with the swept azimuth as variable.
//
// With w = 1/r it is Binet's equation, w'' = 3 w^2 - w, regular at infinity (w = 0) and around the
// light circle (w = 1/3), but not at the singularity, where w ~ 2/phi^2.  There q = sqrt(r) is
// regular: inserting w = q^-2 and the first integral w'^2 = c - w^2 + 2 w^3, c = (E/L)^2, gives
//
//   q'' = -q/4 + 3 c q^5 / 4,
//
// whose only trace of the singularity is q = 0.  Inside the horizon q serves where 2 w^3 > c: there
// the difference w'^2 - 2 w^3 of large numbers would forget c.  Elsewhere w serves; a nearly radial
// ray, c > 2 w^3, is a straight line in w, while in q an error grows as phi^(5/2) along it.
//
// Backward in time dr/dp = -k^r and dphi/dp = L/r^2, so w' = k^r / L.  Each form is scaled: y is w
// or q over its first value, and psi = phi / kappa with kappa = min(1, L / (r |k^r|)), so that
// nearly radial rays, straight lines in y, neither overflow nor need small steps.

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <optional>

#include "pipeline/optics/ray_methods.h"
#include "pipeline/optics/scaled_step_control.h"

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

using State = std::array<double, 2>;  // y, dy/dpsi

// Where a form takes over from the other.  Inwards a ray that has passed the horizon has no turning
// point left (c - w^2 + 2 w^3 > 0 for w > 1/2); the gaps keep a ray that turns near 2 in one form.
constexpr double kToRootInwards = 2.0, kToInverseOutwards = 2.25;
constexpr double kGapOfShares = 2.0;  // in c r^3 / 2

enum class Form { kInverse, kRoot };  // w, q

// The equation of either form, y'' = linear y + power y^2 or y^5.
struct Equation {
  Form form;
  double energy_over_l;
  double unit;   // r where y = 1
  double kappa;  // phi = kappa psi
  double linear, power;
  long* evaluations;

  void operator()(const State& y, State& dy, double /*psi*/) const {
    ++*evaluations;
    const double square = y[0] * y[0];
    const double high = form == Form::kInverse ? square : square * square * y[0];
    dy = {y[1], linear * y[0] + power * high};
  }

  // The second component is measured against a turn of the orbit too: its own size says nothing at
  // a turning point.
  State scale(const State& y, const State& dy, double h) const {
    return {std::abs(y[0]) + std::abs(h * dy[0]), std::abs(y[1]) + kappa * std::abs(y[0])};
  }

  double radius(const State& y) const {
    return form == Form::kInverse ? unit / y[0] : unit * y[0] * y[0];
  }
  // dln(w)/dphi
  double steepness(const State& y) const {
    return y[1] / (y[0] * kappa) * (form == Form::kInverse ? 1 : -2);
  }
};

struct Arc {
  Equation equation;
  State y;
};

// c = (E/L)^2; steepness = dln(w)/dphi = r k^r / L.
Arc arc_at(double r, double steepness, double energy_over_l, Form form, long* evaluations) {
  const double kappa = 1 / std::max(1.0, std::abs(steepness));
  const double slope = kappa * steepness;
  if (form == Form::kInverse)
    return {{form, energy_over_l, r, kappa, -kappa * kappa, 3 * kappa * kappa / r, evaluations},
            {1, slope}};
  const double scaled_energy = kappa * energy_over_l * r;
  return {{form, energy_over_l, r, kappa, -kappa * kappa / 4, 0.75 * scaled_energy * scaled_energy,
           evaluations},
          {1, -slope / 2}};
}

// The part of a step h from y after which y vanishes, by Newton's method on the step itself, so
// that the event is as accurate as a step.
template <class ErrorStepper>
double part_to_zero(const Equation& equation, const State& y, double h) {
  constexpr int kIterations = 12;
  double part = h * 0.5;
  for (int i = 0; i < kIterations; ++i) {
    ErrorStepper stepper;
    State at{};
    stepper.do_step(equation, y, 0.0, at, part);
    const double next = std::clamp(part - at[0] / at[1], 0.0, h);
    if (std::abs(next - part) <= std::numeric_limits<double>::epsilon() * h) return next;
    part = next;
  }
  return part;
}

SkyRegion origin_of(Form form, double energy) {
  return form == Form::kRoot ? SkyRegion::kIV : sky_of(energy);
}

// A radial ray has no azimuth to follow and no turning point: its direction says all.
IntegratedRay radial_ray(const PhotonAtObserver& photon) {
  return {photon.radial > 0 ? SkyRegion::kIV : sky_of(photon.energy), 0, 0, 0, 0};
}

// c / 2 w^3: above 1 the ray is nearly radial.
double radial_share(double r, double energy_over_l) {
  return energy_over_l * energy_over_l * r * r * r / 2;
}

Form first_form(double r, double energy_over_l) {
  return r < kToRootInwards && radial_share(r, energy_over_l) < 1 ? Form::kRoot : Form::kInverse;
}

bool other_form_is_due(const Equation& equation, const State& y) {
  const double r = equation.radius(y), steepness = equation.steepness(y);
  const double share = radial_share(r, equation.energy_over_l);
  if (equation.form == Form::kInverse)
    return steepness > 0 && r < kToRootInwards && share < 1 / kGapOfShares;
  return steepness < 0 && (r > kToInverseOutwards || share > kGapOfShares);
}

template <class ErrorStepper>
IntegratedRay binet_ray(const PhotonAtObserver& photon, double tolerance, double until) {
  if (photon.angular_momentum == 0) return radial_ray(photon);
  using Stepper = ScaledStepper<ErrorStepper, Equation>;
  constexpr double kFirstStep = 0.01, kLargestStep = 1;  // of psi; of phi, radians

  IntegratedRay ray = undecided_ray();
  const double energy_over_l = photon.energy / photon.angular_momentum;
  Arc arc = arc_at(photon.r, photon.r * (photon.radial / photon.angular_momentum), energy_over_l,
                   first_form(photon.r, energy_over_l), &ray.evaluations);
  std::optional<Stepper> stepper;
  double phi = 0, psi = 0, h = kFirstStep;
  for (; ray.steps < kRayStepBudget; ++ray.steps) {
    const State before = arc.y;
    const double psi_before = psi;
    // The last step again, as far as it is wanted.
    const auto stopped = [&] {
      ErrorStepper error_stepper;
      State at{};
      const double part = (until - phi) / arc.equation.kappa - psi_before;
      error_stepper.do_step(arc.equation, before, 0.0, at, part);
      ray.phi = until;
      ray.r = arc.equation.radius(at);
      ++ray.steps;
      return ray;
    };
    h = std::min(h, kLargestStep / arc.equation.kappa);
    if (!stepper)
      stepper.emplace(ScaledErrorChecker(arc.equation, tolerance),
                      typename Stepper::step_adjuster_type(), blank_stepper<ErrorStepper>());
    if (stepper->try_step(arc.equation, arc.y, psi, h) != odeint::success) continue;
    if (arc.y[0] <= 0) {
      psi = psi_before + part_to_zero<ErrorStepper>(arc.equation, before, psi - psi_before);
      if (phi + arc.equation.kappa * psi > until) return stopped();
      ray.origin = origin_of(arc.equation.form, photon.energy);
      ray.phi = phi + arc.equation.kappa * psi;
      ++ray.steps;
      return ray;
    }
    if (phi + arc.equation.kappa * psi >= until) return stopped();
    if (!other_form_is_due(arc.equation, arc.y)) continue;
    phi += arc.equation.kappa * psi;
    psi = 0;
    h = kFirstStep;
    arc = arc_at(arc.equation.radius(arc.y), arc.equation.steepness(arc.y), energy_over_l,
                 arc.equation.form == Form::kRoot ? Form::kInverse : Form::kRoot, &ray.evaluations);
    stepper.reset();
  }
  return ray;
}

}  // namespace

IntegratedRay binet_ray_dopri5(const PhotonAtObserver& photon, double tolerance, double until) {
  return binet_ray<odeint::runge_kutta_dopri5<State>>(photon, tolerance, until);
}

IntegratedRay binet_ray_rkf78(const PhotonAtObserver& photon, double tolerance, double until) {
  return binet_ray<odeint::runge_kutta_fehlberg78<State>>(photon, tolerance, until);
}

}  // namespace domefall
