// A ray is followed here by its orbit's own equation, with the swept azimuth as variable.  With w =
// 1/r it is Binet's equation, w'' = 3 w^2 - w.  It is regular at infinity (w = 0) and around the
// light circle (w = 1/3), but not at the singularity, where w ~ 2/phi^2.  There q = sqrt(r) is
// regular.  Inserting w = q^-2 and the first integral w'^2 = c - w^2 + 2 w^3, c = (E/L)^2, gives
//
//   q'' = -q/4 + 3 c q^5 / 4,
//
// whose only trace of the singularity is q = 0.  Inside the horizon q serves where 2 w^3 > c,
// because there the difference w'^2 - 2 w^3 of large numbers would forget c.  Elsewhere w serves.
// A nearly radial ray, c > 2 w^3, is a straight line in w, while in q an error grows as phi^(5/2)
// along it.
//
// Backward in time dr/dp = -k^r and dphi/dp = L/r^2, so w' = k^r / L.  Each form is scaled: y is w
// or q over its first value, and psi = phi / kappa with kappa = min(1, L / (r |k^r|)), so that
// nearly radial rays, straight lines in y, neither overflow nor need small steps.
//
// Where a ray is stopped on its way, a third component counts the time.  With e = E/L and p = w',
// for which p^2 = e^2 - (1 - 2 w) w^2, backward in time dt = -e dphi/((1 - 2 w) w^2) and dr* = -p
// dphi/((1 - 2 w) w^2), so that
//
//   dv/dphi = -1/(e - p)   and   du/dphi = -1/(e + p).
//
// One of them is regular wherever the ray is, and du = dv - 2 dr* leads from one to the other.

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <optional>

#include "pipeline/light/emission_time.h"
#include "pipeline/light/ray_methods.h"
#include "pipeline/light/scaled_step_control.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

using OrbitState = std::array<double, 3>;  // y, dy/dpsi, and v or u less the observer's

// Here a form takes over from the other.  Inwards a ray that has passed the horizon has no turning
// point left (c - w^2 + 2 w^3 > 0 for w > 1/2).  The gaps keep a ray that turns near 2 in one form.
constexpr double kToRootInwards = 2.0, kToInverseOutwards = 2.25;
constexpr double kGapOfShares = 2.0;  // in c r^3 / 2

enum class Form { kInverse, kRoot };  // w, q
enum class Counted { kNothing, kV, kU };

// An Equation is that of either form, y'' = linear y + power y^2 or y^5.
struct Equation {
  Form form;
  double energy_over_l;
  double unit;   // r where y = 1
  double kappa;  // phi = kappa psi
  double linear, power;
  Counted counted;
  long* evaluations;

  void operator()(const OrbitState& y, OrbitState& dy, double /*psi*/) const {
    ++*evaluations;
    const double square = y[0] * y[0];
    const double high = form == Form::kInverse ? square : square * square * y[0];
    dy = {y[1], linear * y[0] + power * high,
          counted == Counted::kNothing ? 0 : -kappa / off_horizon(y, counted)};
  }

  // The second component is measured against a turn of the orbit too, because its own size says
  // nothing at a turning point.
  OrbitState scale(const OrbitState& y, const OrbitState& dy, double h) const {
    return {std::abs(y[0]) + std::abs(h * dy[0]), std::abs(y[1]) + kappa * std::abs(y[0]),
            counted == Counted::kNothing ? 1 : std::abs(y[2]) + std::abs(h * dy[2])};
  }

  double radius(const OrbitState& y) const {
    return form == Form::kInverse ? unit / y[0] : unit * y[0] * y[0];
  }
  // dln(w)/dphi
  double steepness(const OrbitState& y) const {
    return y[1] / (y[0] * kappa) * (form == Form::kInverse ? 1 : -2);
  }
  // Returns e - p for v and e + p for u.  It vanishes on the horizon where that is infinite.
  double off_horizon(const OrbitState& y, Counted of) const {
    const double p = steepness(y) / radius(y);
    return of == Counted::kV ? energy_over_l - p : energy_over_l + p;
  }
};

struct Arc {
  Equation equation;
  OrbitState y;
};

// Here c = (E/L)^2 and steepness = dln(w)/dphi = r k^r / L.  `time` is what has been counted.
Arc arc_at(double r, double steepness, double energy_over_l, Form form, Counted counted,
           double time, long* evaluations) {
  const double kappa = 1 / std::max(1.0, std::abs(steepness));
  const double slope = kappa * steepness, square = kappa * kappa;
  const double scaled_energy = kappa * energy_over_l * r;
  const bool inverse = form == Form::kInverse;
  return {{form, energy_over_l, r, kappa, inverse ? -square : -square / 4,
           inverse ? 3 * square / r : 0.75 * scaled_energy * scaled_energy, counted, evaluations},
          {1, inverse ? slope : -slope / 2, time}};
}

// Returns the null coordinates of the place less those of the observer.  arc.y[2] is v or u of the
// place, whichever is counted now, less the coordinate `began` of the observer: a change of
// coordinate adds or subtracts 2 r* = v - u of the place.  The observer's own r*, which is infinite
// on the horizon, enters only the other one of the two results.
NullTimes passed_times(const Arc& arc, Counted began, double observer_star) {
  const double there = 2 * Schwarzschild::tortoise(arc.equation.radius(arc.y)), time = arc.y[2];
  const bool counts_v = arc.equation.counted == Counted::kV;
  if (began == Counted::kV) {
    const double v = counts_v ? time : time + there;
    return {v, v - there + 2 * observer_star};
  }
  const double u = counts_v ? time - there : time;
  return {u + there - 2 * observer_star, u};
}

// Counts the other coordinate from here on if that is further off its horizon, by a factor that
// keeps a ray between the two from changing to and fro.  Says whether it is so.
bool change_coordinate(Arc& arc) {
  constexpr double kGap = 2;
  const auto off = [&arc](Counted of) { return std::abs(arc.equation.off_horizon(arc.y, of)); };
  const Counted now = arc.equation.counted, other = now == Counted::kV ? Counted::kU : Counted::kV;
  if (kGap * off(now) > off(other)) return false;
  const double there = 2 * Schwarzschild::tortoise(arc.equation.radius(arc.y));
  arc.y[2] += other == Counted::kV ? there : -there;
  arc.equation.counted = other;
  return true;
}

// Returns the step of psi over which e - p or e + p changes by a tenth of itself, p' being 3 w^2 -
// w, so that none passes the horizon where the coordinate in use is infinite.  Fehlberg's 7(8) is
// blind to the time's error, because its two formulas differ by stages at the ends of the step, of
// which a quadrature sees no difference.  A distance below the tolerance is what the steps have
// left of it.  Within r = 1, on the way to the singularity, no horizon is near.
double step_to_horizon(const Arc& arc, double tolerance) {
  constexpr double kShare = 0.1;
  const double w = 1 / arc.equation.radius(arc.y), rate = std::abs(w * (3 * w - 1));
  if (w > 1) return std::numeric_limits<double>::max();
  const double off =
      std::max(std::abs(arc.equation.off_horizon(arc.y, arc.equation.counted)), tolerance * w);
  return kShare * off / (arc.equation.kappa * rate + std::numeric_limits<double>::min());
}

// Returns the part of a step h from y after which y vanishes, by Newton's method on the step
// itself, so that the event is as accurate as a step.
template <class ErrorStepper>
double part_to_zero(const Equation& equation, const OrbitState& y, double h) {
  constexpr int kIterations = 12;
  double part = h * 0.5;
  for (int i = 0; i < kIterations; ++i) {
    ErrorStepper stepper;
    OrbitState at{};
    stepper.do_step(equation, y, 0.0, at, part);
    const double next = std::clamp(part - at[0] / at[1], 0.0, h);
    if (std::abs(next - part) <= std::numeric_limits<double>::epsilon() * h) return next;
    part = next;
  }
  return part;
}

SkyRegion origin_at_zero(Form form, double energy) {
  return form == Form::kRoot ? SkyRegion::kIV : sky_of(energy);
}

// A radial ray has no azimuth to follow and no turning point, so its direction says all.
IntegratedRay radial_ray(const PhotonAtObserver& photon) {
  return {photon.radial > 0 ? SkyRegion::kIV : sky_of(photon.energy), 0, 0, 0, 0, {}};
}

// Returns c / 2 w^3.  Above 1 the ray is nearly radial.
double radial_share(double r, double energy_over_l) {
  return energy_over_l * energy_over_l * r * r * r / 2;
}

Form first_form(double r, double energy_over_l) {
  return r < kToRootInwards && radial_share(r, energy_over_l) < 1 ? Form::kRoot : Form::kInverse;
}

bool other_form_is_due(const Equation& equation, const OrbitState& y) {
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
  const double observer_star = Schwarzschild::tortoise(photon.r);
  const bool stops = std::isfinite(until);
  const Counted regular = photon.energy * photon.radial > 0 ? Counted::kU : Counted::kV;
  Arc arc = arc_at(photon.r, photon.r * (photon.radial / photon.angular_momentum), energy_over_l,
                   first_form(photon.r, energy_over_l), stops ? regular : Counted::kNothing, 0,
                   &ray.evaluations);
  std::optional<Stepper> stepper;
  double phi = 0, psi = 0, h = kFirstStep;
  for (; ray.steps < kRayStepBudget; ++ray.steps) {
    const OrbitState before = arc.y;
    const double psi_before = psi;
    // The last step is made again, as far as it is wanted.
    const auto stopped = [&] {
      ErrorStepper error_stepper;
      OrbitState at{};
      const double part = (until - phi) / arc.equation.kappa - psi_before;
      error_stepper.do_step(arc.equation, before, 0.0, at, part);
      ray.phi = until;
      ray.r = arc.equation.radius(at);
      ray.passed = passed_times({arc.equation, at}, regular, observer_star);
      ++ray.steps;
      return ray;
    };
    h = std::min(h, kLargestStep / arc.equation.kappa);
    if (stops) h = std::min(h, step_to_horizon(arc, tolerance));
    if (!stepper)
      stepper.emplace(ScaledErrorChecker(arc.equation, tolerance),
                      typename Stepper::step_adjuster_type(), blank_stepper<ErrorStepper>());
    if (stepper->try_step(arc.equation, arc.y, psi, h) != odeint::success) continue;
    if (arc.y[0] <= 0) {
      psi = psi_before + part_to_zero<ErrorStepper>(arc.equation, before, psi - psi_before);
      if (phi + arc.equation.kappa * psi > until) return stopped();
      ray.origin = origin_at_zero(arc.equation.form, photon.energy);
      ray.phi = phi + arc.equation.kappa * psi;
      ++ray.steps;
      return ray;
    }
    if (phi + arc.equation.kappa * psi >= until) return stopped();
    if (stops && change_coordinate(arc)) stepper.reset();
    if (!other_form_is_due(arc.equation, arc.y)) continue;
    phi += arc.equation.kappa * psi;
    psi = 0;
    h = kFirstStep;
    arc = arc_at(arc.equation.radius(arc.y), arc.equation.steepness(arc.y), energy_over_l,
                 arc.equation.form == Form::kRoot ? Form::kInverse : Form::kRoot,
                 arc.equation.counted, arc.y[2], &ray.evaluations);
    stepper.reset();
  }
  return ray;
}

}  // namespace

IntegratedRay binet_ray_dopri5(const PhotonAtObserver& photon, double tolerance, double until) {
  return binet_ray<odeint::runge_kutta_dopri5<OrbitState>>(photon, tolerance, until);
}

IntegratedRay binet_ray_rkf78(const PhotonAtObserver& photon, double tolerance, double until) {
  return binet_ray<odeint::runge_kutta_fehlberg78<OrbitState>>(photon, tolerance, until);
}

}  // namespace domefall
