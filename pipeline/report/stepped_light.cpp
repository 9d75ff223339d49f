#include "pipeline/report/stepped_light.h"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>

#include "pipeline/report/reference/kerr_schild.h"

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;
using odeint::array_algebra;

constexpr int kMostLightSteps = 100'000;

// The numbers of a ray begin as 0 because Odeint also copies buffers that it has not filled yet.
template <std::size_t count>
struct RayNumbers : std::array<double, count> {
  RayNumbers() : std::array<double, count>{} {}
};

// Steps until done(y, at), if that comes, and then calls end(step, at), where step(y, by) is a step of
// any length.  No step is longer than longest(y), over which the error of a step could miss a bend.
template <class State, class System, class Longest, class Done, class End>
bool follow_light(FallMethod method, double tolerance, const System& system, State& y,
                  const Longest& longest, const Done& done, const End& end) {
  const auto by = [&](auto pair) {
    using Controlled = odeint::controlled_runge_kutta<decltype(pair)>;
    Controlled controlled(typename Controlled::error_checker_type(tolerance, tolerance));
    double at = 0, step = 1e-3;
    for (int k = 0; k < kMostLightSteps && std::isfinite(y[0]); ++k) {
      if (done(y, at)) {
        end([&](State& from, double length) { pair.do_step(system, from, at, length); }, at);
        return true;
      }
      step = std::min(step, longest(y));
      controlled.try_step(system, y, at, step);
    }
    return false;
  };
  using Dopri5 = odeint::runge_kutta_dopri5<State, double, State, double, array_algebra>;
  using Fehlberg78 = odeint::runge_kutta_fehlberg78<State, double, State, double, array_algebra>;
  return method == FallMethod::kDopri5 ? by(Dopri5()) : by(Fehlberg78());
}

struct Shape {
  double r, slope;  // r and dr/dl
};

Shape shape_at(const Wormhole& wormhole, double l) {
  if (wormhole.profile == Wormhole::Profile::kEllis)
    return {std::hypot(l, 1.0), l / std::hypot(l, 1.0)};
  const double m = wormhole.lensing_mass(), beyond = std::abs(l) - wormhole.length / 2;
  if (beyond <= 0) return {1, 0};
  const double x = 2 * beyond / (std::numbers::pi * m), arc = std::atan(x);
  return {1 + m * (x * arc - std::log1p(x * x) / 2), std::copysign(2 * arc / std::numbers::pi, l)};
}

// A ray about a spin as its observer knows it.
struct SpinStart {
  double a, h, q, r, theta;  // h = a^2 + q^2
  double delta, eta;
  bool mirrored = false;  // in the plane phi = 0
  // (r^2 + a^2 cos^2 theta)^(1/2), E, Y = L - aE sin^2(theta), K, r'
  double root = 0, energy = 0, y = 0, k = 0, speed = 0;

  explicit SpinStart(const SpinRequest& request)
      : a(static_cast<double>(request.at.hole.spin)),
        h(static_cast<double>(request.at.hole.squares())),
        q(static_cast<double>(request.at.hole.charge)),
        r(static_cast<double>(request.at.r)),
        theta(static_cast<double>(request.at.theta)),
        delta(static_cast<double>(request.direction.delta)),
        eta(static_cast<double>(request.direction.eta)) {
    set_constants();
    if (energy >= 0) return;
    // The mirror image has -E, -L, the same K and r', and hence another direction.
    mirrored = true;
    const double p = -root * root * energy + a * y, gap = r * (r - 2) + h;
    const double ahead = p > 0 ? k / (p - speed) : (p + speed) / gap;
    const double back = (p - speed) / (2 * root * root);
    eta = -eta;
    delta = std::atan2(std::sqrt(k) / root, ahead / 2 - back);
    set_constants();
  }

  // Undoes the mirror, and gives the sky its own angle, less 2 r# of the observer.
  FollowedRay ray(const KerrHole& hole, const V3d& place) const {
    if (!mirrored) return {SkyRegion::kI, 0, place};
    const auto turn = static_cast<double>(-2 * hole.twist(r));
    const double c = std::cos(turn), s = std::sin(turn);
    return {SkyRegion::kIII, 0, {place.x * c + place.y * s, place.x * s - place.y * c, place.z}};
  }

 private:
  void set_constants() {
    const double s = std::sin(delta / 2), c = std::cos(delta / 2), gap = r * (r - 2) + h;
    const double ac = a * std::cos(theta), sigma = r * r + ac * ac;
    root = std::sqrt(sigma);
    y = root * std::sin(theta) * 2 * s * c * std::sin(eta);
    k = 4 * sigma * s * s * c * c;
    speed = gap * c * c - sigma * s * s;
    energy = (sigma * s * s + gap * c * c + a * y) / sigma;
  }
};

}  // namespace

FollowedRay step_charged_ray(const ChargedRequest& request, FallMethod method, double tolerance) {
  const double q2 = request.hole.charge * request.hole.charge, r = request.at.r;
  const auto delta = static_cast<double>(request.delta);
  const double s = std::sin(delta / 2), c = std::cos(delta / 2), f = 1 - (2 - q2 / r) / r;
  RayNumbers<2> y;
  y[0] = 1 / r, y[1] = (f * c * c - s * s) / (2 * r * s * c);
  double phi = 0;
  constexpr double kMostTurned = 100;  // radians
  const bool ended = follow_light(
      method, tolerance,
      [q2](const RayNumbers<2>& at, RayNumbers<2>& rate, double) {
        const double w = at[0];
        rate[0] = at[1], rate[1] = w * (-1 + w * (3 - 2 * q2 * w));
      },
      y, [](const RayNumbers<2>&) { return 1.0; },
      [](const RayNumbers<2>& at, double turned) { return at[0] <= 0 || turned > kMostTurned; },
      [&](const auto& step, double at) {
        phi = at;
        for (int k = 0; k < 3; ++k) {
          const double rest = -y[0] / y[1];
          step(y, rest), phi += rest;
        }
      });
  if (!ended || std::abs(y[0]) > 1e-9) return {std::nullopt, 0};
  return {s * s + f * c * c > 0 ? SkyRegion::kI : SkyRegion::kIII, phi};
}

FollowedRay step_wormhole_ray(const WormholeRequest& request, FallMethod method, double tolerance) {
  const Wormhole& wormhole = request.wormhole;
  const double side = request.l < 0 ? -1 : 1, far = 1e8 * (1 + std::abs(request.l));
  // At a mouth of dngr r'' jumps, which a step crosses with a small part of the way.
  const bool dngr = wormhole.profile == Wormhole::Profile::kDngr;
  const double least = dngr ? 1e-3 * std::min(1.0, wormhole.lensing_mass()) : 1;
  const double b = shape_at(wormhole, request.l).r * std::sin(request.delta);
  RayNumbers<3> y;
  y[0] = request.l, y[1] = -side * std::cos(request.delta);
  const bool ended = follow_light(
      method, tolerance,
      [&](const RayNumbers<3>& at, RayNumbers<3>& rate, double) {
        const Shape shape = shape_at(wormhole, at[0]);
        rate[0] = at[1], rate[1] = b * b * shape.slope / (shape.r * shape.r * shape.r);
        rate[2] = b / (shape.r * shape.r);
      },
      y,
      [&](const RayNumbers<3>& at) {
        return (least + std::abs(std::abs(at[0]) - wormhole.half_length())) / (4 * std::abs(at[1]));
      },
      [&](const RayNumbers<3>& at, double) { return std::abs(at[0]) > far && at[0] * at[1] > 0; },
      [](const auto&, double) {});
  if (!ended) return {std::nullopt, 0};
  return {side * y[0] > 0 ? SkyRegion::kI : SkyRegion::kIII, y[2] + b / std::abs(y[0])};
}

FollowedRay step_ray_over_mino_time(const SpinRequest& request, FallMethod method,
                                    double tolerance) {
  const SpinStart start(request);
  const double a = start.a, h = start.h, sine = std::sin(start.theta),
               cosine = std::cos(start.theta);
  // Time is counted so that E or the speed on the sphere of directions is 1 or so.
  const double unit = std::max(std::sqrt(start.k), std::abs(start.energy));
  const double e = start.energy / unit, k = start.k / unit / unit, r2 = start.r * start.r;
  const double l = start.y / unit + a * e * sine * sine, g = a * (a * e - l), ae2 = a * a * e * e;
  const double c = k + 2 * a * e * l - ae2, size = start.root * std::sin(start.delta) / unit;
  const double up = -size * std::cos(start.eta), side = -size * std::sin(start.eta) - a * e * sine;
  // w, w', N, N', psi
  RayNumbers<9> y;
  y[0] = 1 / start.r, y[1] = start.speed / unit / r2;
  y[2] = sine, y[4] = cosine, y[5] = cosine * up, y[6] = side, y[7] = -sine * up;
  const double horizon = 1 / static_cast<double>(request.at.hole.horizon());
  const auto rate = [=](const RayNumbers<9>& at, RayNumbers<9>& by, double) {
    const double w = at[0], w2 = w * w, p = e + g * w2, d = 1 - 2 * w + h * w2;
    by[0] = at[1];
    by[1] = 2 * g * w * p - k * w * (1 - 3 * w + 2 * h * w2);
    const double turn = c + 2 * ae2 * at[4] * at[4];
    for (std::size_t i = 2; i < 5; ++i) by[i] = at[i + 3], by[i + 3] = -turn * at[i];
    by[7] += ae2 * at[4];
    const double ahead = (p > 0) != (at[1] > 0) ? k * w2 / (p - at[1]) : (p + at[1]) / d;
    by[8] = a * (e - ahead);
  };
  bool sky = false;
  follow_light(
      method, tolerance, rate, y, [](const RayNumbers<9>&) { return 1.0; },
      [&](const RayNumbers<9>& at, double) {
        sky = at[0] <= 0;
        return sky || (at[0] >= horizon && at[1] > 0);
      },
      [&](const auto& step, double) {
        for (int i = 0; i < 3 && sky; ++i) step(y, -y[0] / y[1]);
      });
  if (!sky || std::abs(y[0]) > 1e-9) return {std::nullopt, 0};
  const double cp = std::cos(y[8]), sp = std::sin(y[8]);
  return start.ray(request.at.hole, {y[2] * cp - y[3] * sp, y[2] * sp + y[3] * cp, y[4]});
}

FollowedRay step_kerr_schild_ray(const SpinRequest& request, FallMethod method, double tolerance) {
  const SpinStart start(request);
  const KerrSchildStart from =
      kerr_schild_start(start.a, start.q, start.r, start.theta, start.delta, start.eta);
  RayNumbers<6> y;
  const double unit = V3d(from.state[3], from.state[4], from.state[5]).length();
  for (std::size_t i = 0; i < 3; ++i) y[i] = from.state[i], y[i + 3] = from.state[i + 3] / unit;
  const KerrSchild hole{from.hole.a, from.hole.q, from.hole.energy / unit};
  const double far = 1e8 * (1 + start.r);
  V3d place(0, 0, 0);
  bool sky = false;
  follow_light(
      method, tolerance, hole, y, [&](const RayNumbers<6>& at) { return hole.radius(at) / 2; },
      // On the past horizon, which light comes ever nearer to, its momentum has no end.
      [&](const RayNumbers<6>& at, double) {
        sky = hole.radius(at) > far;
        return sky || !(V3d(at[3], at[4], at[5]).length() < 1e9);
      },
      [&](const auto&, double) {
        KerrSchildState change;
        hole(y, change, 0);
        place = V3d(change[0], change[1], change[2]).normalized();
      });
  if (!sky) return {std::nullopt, 0};
  return start.ray(request.at.hole, place);
}

}  // namespace domefall
