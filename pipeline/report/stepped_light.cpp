#include "pipeline/report/stepped_light.h"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>

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

}  // namespace domefall
