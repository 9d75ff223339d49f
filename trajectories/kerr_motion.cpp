#include "trajectories/kerr_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

struct Metric {
  double spin, squares, charged, sigma, sine2;  // a, a^2 + q^2, 2r - q^2, ...

  Metric(const KerrHole& hole, double r, double theta)
      : spin(static_cast<double>(hole.spin)),
        squares(static_cast<double>(hole.squares())),
        charged(2 * r - static_cast<double>(hole.charge * hole.charge)),
        sigma(r * r + spin * spin * std::cos(theta) * std::cos(theta)),
        sine2(std::sin(theta) * std::sin(theta)) {}
  double tt() const { return 1 - charged / sigma; }
  double tphi() const { return spin * sine2 * charged / sigma; }
  // -g_phiphi/sin^2
  double around(double r) const {
    return r * r + spin * spin + spin * spin * sine2 * charged / sigma;
  }
};

// Returns E^2 - 1, by E - 1 = (T - 1) - m (T + R)/Sigma + a sin(theta) Phi/sqrt Sigma with 2m = Sigma -
// Delta, which keeps its digits far away.
double excess_of(const Metric& g, double theta, const Celerity<ReferenceTetrad>& u, double energy) {
  const double time = gamma_of(u);
  if (time > 2) return (energy - 1) * (energy + 1);
  const double m = (g.charged - g.spin * g.spin * g.sine2) / 2;
  const double above = u.length2() / (1 + time) - m * (time + u.x) / g.sigma +
                       g.spin * std::sin(theta) * u.z / std::sqrt(g.sigma);
  return above * (energy + 1);
}

}  // namespace

double along_falling(const KerrHole& hole, double r, double p, double speed, double carter) {
  return speed <= 0 ? (r * r + carter) / (p - speed)
                    : (p + speed) / static_cast<double>(hole.delta(r));
}

KerrMotion kerr_motion(const KerrHole& hole, double r, double theta,
                       const Celerity<ReferenceTetrad>& u) {
  const Metric g(hole, r, theta);
  const double a = g.spin, root = std::sqrt(g.sigma), sine = std::sin(theta);
  const double time = gamma_of(u);
  // u^T - u^R without a difference of like numbers.
  const double across2 = 1 + u.y * u.y + u.z * u.z;
  const double outward = u.x > 0 ? time + u.x : across2 / (time - u.x);
  const double b = u.x > 0 ? across2 / (2 * (time + u.x)) : (time - u.x) / 2;
  const double p = g.sigma * b + outward * static_cast<double>(hole.delta(r)) / 2;
  const double around = root * sine * u.z;  // Y
  const double energy = (p + a * around) / g.sigma;
  const double cosine = std::cos(theta);
  return {energy, excess_of(g, theta, u, energy), around + a * energy * sine * sine,
          g.sigma * (u.y * u.y + u.z * u.z) + a * a * cosine * cosine, u};
}

std::optional<KerrMotion> kerr_motion(const KerrHole& hole, double r, double theta, double energy,
                                      double momentum, double carter_q, int sign_r,
                                      int sign_theta) {
  const Metric g(hole, r, theta);
  const double a = g.spin, sine = std::sin(theta), cosine = std::cos(theta);
  const double over = momentum - a * energy, carter = carter_q + over * over;
  const double p = (r * r + a * a) * energy - a * momentum;
  const auto root = [](double square, double scale) -> std::optional<double> {
    if (square < -1e-11 * scale) return std::nullopt;
    return std::sqrt(std::max(square, 0.0));
  };
  const double delta = static_cast<double>(hole.delta(r)), falling = delta * (r * r + carter);
  const auto speed = root(p * p - falling, p * p + std::abs(falling));
  // (L - aE sin^2)/sin, which on the axis is that of a passage.
  const double around = sine > 0 ? momentum / sine - a * energy * sine : 0;
  const auto polar =
      root(carter - a * a * cosine * cosine - around * around, std::abs(carter) + around * around);
  if (!speed || !polar) return std::nullopt;
  const double rate = sign_r * *speed, outward = along_falling(hole, r, p, rate, carter),
               b = (p - rate) / (2 * g.sigma), size = std::sqrt(g.sigma);
  return KerrMotion{energy,
                    (energy - 1) * (energy + 1),
                    momentum,
                    carter,
                    {outward / 2 - b, sign_theta * *polar / size, around / size}};
}

double dragged_velocity(const KerrHole& hole, double r, double theta, double speed) {
  const Metric g(hole, r, theta);
  const double around = g.around(r), dragged = g.spin * g.charged / (g.sigma * around);
  if (speed == 0) return dragged;
  return dragged +
         speed * std::sqrt(static_cast<double>(hole.delta(r))) / (around * std::sin(theta));
}

std::optional<KerrMotion> kerr_circling(const KerrHole& hole, double r, double theta,
                                        double velocity) {
  const Metric g(hole, r, theta);
  const double own = g.tt() + 2 * velocity * g.tphi() - velocity * velocity * g.sine2 * g.around(r);
  const auto delta = static_cast<double>(hole.delta(r));
  if (!(own > 0 && r > static_cast<double>(hole.horizon()))) return std::nullopt;
  const double time = 1 / std::sqrt(own);
  const double energy = time * (g.tt() + velocity * g.tphi());
  const double per_sine2 =
      time * (velocity * g.around(r) - g.spin * g.charged / g.sigma);  // L/sin^2
  const double a = g.spin, momentum = per_sine2 * g.sine2;
  const double p = (r * r + a * a) * energy - a * momentum, cosine = std::cos(theta);
  const double around = (per_sine2 - a * energy) * std::sin(theta);
  const Celerity<ReferenceTetrad> celerity{p / (2 * delta) - p / (2 * g.sigma), 0,
                                           around / std::sqrt(g.sigma)};
  return KerrMotion{energy, excess_of(g, theta, celerity, energy), momentum,
                    around * around + a * a * cosine * cosine, celerity};
}

KerrMotion kerr_dragged(const KerrHole& hole, double r, double theta, double momentum) {
  const Metric g(hole, r, theta);
  const double own = momentum != 0 ? momentum / std::sqrt(g.sine2 * g.around(r)) : 0;
  return kerr_circling(hole, r, theta,
                       dragged_velocity(hole, r, theta, own / std::sqrt(1 + own * own)))
      .value();
}

double circling_rate(const KerrHole& hole, double r, double theta, double velocity) {
  const Metric g(hole, r, theta);
  return 1 /
         std::sqrt(g.tt() + 2 * velocity * g.tphi() - velocity * velocity * g.sine2 * g.around(r));
}

namespace {

struct BoundConstants {
  double energy2, momentum, carter_q;
};

// Over both ends of the axis L = 0, and where r turns
//
//     E^2 [(r^2 + a^2)^2/Delta - a^2] = r^2 + Q.
std::optional<BoundConstants> polar_constants(const KerrHole& hole, double periastron,
                                              double apoastron) {
  const auto a2 = static_cast<double>(hole.spin * hole.spin);
  const double r = periastron, far = apoastron, sum = r + far;
  const auto delta = static_cast<double>(hole.delta(r)),
             delta_far = static_cast<double>(hole.delta(far));
  const double squares = r * r + a2, pull = squares * squares / delta;
  // The differences of both sides, over that of the radii.
  const double steepness = sum * (squares + far * far + a2) - pull * (sum - 2);
  const double energy2 = sum * delta_far / steepness;
  if (!(energy2 > 0 && energy2 < 1)) return std::nullopt;
  return BoundConstants{energy2, 0, (pull - a2) * energy2 - r * r};
}

// With Q = z [a^2 (1 - E^2) + L^2/(1 - z)], z = sin^2 of the inclination, where r turns
//
//     f E^2 - 2 g E L - h L^2 - d = 0
//
// (W. Schmidt, Class. Quantum Grav. 19, 2743 (2002), here with a charge).  By one such radius, and the
// difference to the other over that of the radii, E^2 has a quadratic.
std::optional<BoundConstants> inclined_constants(const KerrHole& hole, double periastron,
                                                 double apoastron, double inclination) {
  const auto a = static_cast<double>(hole.spin), q = static_cast<double>(hole.charge);
  const double sine = std::sin(inclination), z = sine * sine, open = (1 - sine) * (1 + sine);
  struct Turn {
    double d, f, g, h;
  };
  const auto turn = [&](double r) {
    const auto delta = static_cast<double>(hole.delta(r));
    return Turn{(r * r + a * a * z) * delta,
                r * r * r * r + a * a * (r * (r + 2) - q * q + z * delta), a * (2 * r - q * q),
                r * (r - 2) + q * q + z / open * delta};
  };
  const double r = periastron, far = apoastron, sum = r + far, rate = sum - 2;
  const Turn one = turn(r),
             two{sum * static_cast<double>(hole.delta(far)) + (r * r + a * a * z) * rate,
                 sum * (r * r + far * far) + a * a * (sum + 2 + z * rate), 2 * a,
                 rate + z / open * rate};
  const auto cross = [](double a1, double b1, double a2, double b2) { return a1 * b2 - a2 * b1; };
  const double kappa = cross(one.d, one.h, two.d, two.h), eps = cross(one.d, one.g, two.d, two.g),
               rho = cross(one.f, one.h, two.f, two.h), eta = cross(one.f, one.g, two.f, two.g),
               sigma = cross(one.g, one.h, two.g, two.h);
  const bool retrograde = inclination > std::numbers::pi / 2;
  const double inner = sigma * (sigma * eps * eps + rho * eps * kappa - eta * kappa * kappa);
  if (!(inner >= 0)) return std::nullopt;
  const double energy2 =
      (kappa * rho + 2 * eps * sigma + (retrograde ? 2 : -2) * std::sqrt(inner)) /
      (rho * rho + 4 * eta * sigma);
  if (!(energy2 > 0 && energy2 < 1)) return std::nullopt;
  const double energy = std::sqrt(energy2);
  // L by that of its roots which has the sense, without a difference of like numbers.
  const double root2 = one.g * one.g * energy2 + (one.f * energy2 - one.d) * one.h;
  if (!(root2 >= 0) || one.h == 0) return std::nullopt;
  const double momentum = (-one.g * energy + (retrograde ? -1 : 1) * std::sqrt(root2)) / one.h;
  if (retrograde != (momentum < 0)) return std::nullopt;
  return BoundConstants{energy2, momentum,
                        z * (a * a * (1 - energy2) + momentum * momentum / open)};
}

}  // namespace

std::optional<KerrMotion> kerr_bound(const KerrHole& hole, double periastron, double apoastron,
                                     double inclination) {
  if (!(periastron > static_cast<double>(hole.horizon()))) return std::nullopt;
  constexpr double kOverTheAxis = 1e-6;
  const auto found = std::abs(std::cos(inclination)) < kOverTheAxis
                         ? polar_constants(hole, periastron, apoastron)
                         : inclined_constants(hole, periastron, apoastron, inclination);
  if (!found) return std::nullopt;
  const double energy = std::sqrt(found->energy2), momentum = found->momentum;
  auto motion =
      kerr_motion(hole, periastron, std::numbers::pi / 2, energy, momentum, found->carter_q, 0, -1);
  if (!motion) return std::nullopt;
  const auto a = static_cast<double>(hole.spin), charges = static_cast<double>(hole.squares());
  const double constant = a * (a * energy - momentum), carter = motion->carter,
               linear = 2 * energy * constant - charges - carter;
  // R = 0 at the apoastron tells 1 - E^2 of a far one to all digits.
  const double w = 1 / apoastron;
  motion->excess =
      -w * (2 + w * (linear + w * (2 * carter + w * (constant * constant - charges * carter))));
  // r must be able to grow from there on.
  const double r = periastron;
  const double pull = 2 * motion->excess * r * r * r + 3 * r * r + linear * r + carter;
  const double terms = 2 * r * r * r + 3 * r * r + carter;
  if (apoastron > periastron ? pull < -1e-12 * terms : std::abs(pull) > 1e-9 * terms)
    return std::nullopt;
  return motion;
}

}  // namespace domefall
