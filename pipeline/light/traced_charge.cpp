#include "pipeline/light/traced_charge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

using Long = long double;

constexpr Long kHalfTurn = std::numbers::pi_v<Long>;

ChargedRequest request_at(Long charge, Long r) {
  // NaN passes none of these comparisons.
  if (!(charge >= 0 && charge <= 100))
    throw InputError(fmt::format("charge must be from 0 to 100 (units of M), got {}",
                                 static_cast<double>(charge)));
  ChargedRequest request;
  request.hole = ChargedHole(1, charge);
  const ChargedHole& hole = request.hole;
  const double q2 = hole.charge * hole.charge;
  const double mark = hole.is_naked() ? q2 : hole.inner_horizon();
  const double least = charge > 0 ? 1e-3 * mark : 1e-9;
  if (!(r >= least && r <= 1e12L))
    throw InputError(fmt::format("r must be from {:.9g} to 1e12 (units of M), got {}", least,
                                 static_cast<double>(r)));
  request.at = hole.at(r);
  if (charge > 0 && !hole.is_naked() && request.at.above_inner == 0)
    throw InputError("r must not be that of the inner horizon");
  return request;
}

// A Turn is a ray turned by an angle from the one that was asked for.
class Turn {
 public:
  explicit Turn(const ChargedRequest& request)
      : request_(request), view_(request.hole, request.at), asked_(ray(0)) {}

  const ChargedView& view() const { return view_; }
  const ChargedRay& asked() const { return asked_; }
  double phi(double turn) const { return view_.azimuth(ray(turn)); }

  // Returns the angle to the nearest place where phi diverges or ends, in the complex plane.
  double smooth_over() const {
    const Long s = asked_.sin_half, c = asked_.cos_half;
    Long least = std::min(s, c);
    if (!view_.circle().exists) return static_cast<double>(2 * least);
    if (!view_.has_edges()) {
      const Long t = view_.tan_half_critical(Critical::kFirst);
      const Long along = (s - t * c) / std::hypot(Long{1}, t);
      return static_cast<double>(2 * std::min(least, std::hypot(along, view_.between_edges() / 4)));
    }
    least = std::min(least, away_from(Critical::kFirst));
    // Outside the circle of light, rays on their way in pass the second without a trace.
    if (view_.at().above_light_circle <= 0) least = std::min(least, away_from(Critical::kSecond));
    return static_cast<double>(2 * least);
  }

 private:
  Long away_from(Critical edge) const {
    const Long gap = edge == Critical::kFirst ? asked_.gap_first : asked_.gap_second;
    return std::abs(gap) / std::hypot(Long{1}, view_.tan_half_critical(edge));
  }

  ChargedRay ray(double turn) const {
    if (request_.edge) return view_.ray_off_edge(*request_.edge, request_.offset + turn);
    PolarAngle angle = polar_angle(request_.delta);
    angle.angle += turn;
    angle.rest -= turn;
    return view_.ray_at(angle);
  }

  const ChargedRequest& request_;
  ChargedView view_;
  ChargedRay asked_;
};

// On the axis light comes straight from the sky, with phi = angle/|E|, or turned at the core.
TracedCharge on_axis(TracedCharge ray, bool straight) {
  ray.phi = 0;
  ray.slope = straight ? 1 / std::abs(ray.energy) : std::numeric_limits<double>::infinity();
  ray.amplification = straight ? ray.energy * ray.energy : 0;
  if (ray.delta > 1) ray.slope = -ray.slope;
  return ray;
}

}  // namespace

ChargedRequest charged_ray_at_angle(Long charge, Long r, Long delta) {
  ChargedRequest request = request_at(charge, r);
  // A decimal that is pi rounded up is taken as pi.
  if (!(delta >= 0 && delta <= kHalfTurn * (1 + 1e-12L)))
    throw InputError(fmt::format("delta must be from 0 to pi, got {}", static_cast<double>(delta)));
  request.delta = std::min(delta, kHalfTurn);
  return request;
}

ChargedRequest charged_ray_at_edge(Long charge, Long r, std::string_view edge, double offset) {
  ChargedRequest request = request_at(charge, r);
  const ChargedView view(request.hole, request.at);
  const bool between = view.lapse_squared() < 0;
  const bool ring = !between && request.at.above_light_circle < 0 && charge > 0;
  if (edge != "silhouette" && edge != "inner" && edge != "region3")
    throw InputError(
        fmt::format("edge must be silhouette, inner, region3 or empty, got '{}'", edge));
  const bool there = edge == "inner" ? ring : edge == "region3" ? between : true;
  if (!view.has_edges() || !there)
    throw InputError(fmt::format("there is no edge {} at this r", edge));
  request.edge = edge == "silhouette" ? Critical::kFirst : Critical::kSecond;
  request.offset = offset;
  const Long place = 2 * std::atan(view.tan_half_critical(*request.edge));
  if (!(offset >= -place * (1 + 1e-12L) && offset <= (kHalfTurn - place) * (1 + 1e-12L)))
    throw InputError(fmt::format("offset must keep delta from 0 to pi, got {}", offset));
  request.delta = std::clamp(place + offset, Long{0}, kHalfTurn);
  return request;
}

TracedCharge trace_charge(const ChargedRequest& request) {
  const Turn turn(request);
  const ChargedView& view = turn.view();
  const ChargedRay& ray = turn.asked();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  TracedCharge traced{static_cast<double>(request.delta),
                      view.origin_of(ray),
                      kInfinite,
                      static_cast<double>(view.energy(ray)),
                      static_cast<double>(2 * request.at.r * ray.sin_half * ray.cos_half),
                      kInfinite,
                      0};
  if (traced.origin == ChargedOrigin::kDark) return traced;
  if (ray.sin_half == 0 || ray.cos_half == 0)
    return on_axis(traced, ray.sin_half > 0 || traced.origin == ChargedOrigin::kParallel);
  const double h = 1e-3 * turn.smooth_over();
  traced.phi = turn.phi(0);
  traced.slope =
      (8 * (turn.phi(h) - turn.phi(-h)) - (turn.phi(2 * h) - turn.phi(-2 * h))) / (12 * h);
  const auto sine = static_cast<double>(2 * ray.sin_half * ray.cos_half);
  traced.amplification = sine / std::abs(std::sin(traced.phi) * traced.slope);
  return traced;
}

}  // namespace domefall
