#include "pipeline/light/kerr_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

constexpr long double kHalfTurn = std::numbers::pi_v<long double>;

double rounded(long double x) { return static_cast<double>(x); }

}  // namespace

KerrPlace kerr_place(const KerrHole& hole, long double r, long double theta) {
  // NaN passes none of these comparisons.
  if (!(hole.charge >= 0))
    throw InputError(fmt::format("charge must be at least 0, got {}", rounded(hole.charge)));
  const KerrPlace place{hole, r, std::min(theta, kHalfTurn)};
  if (!(hole.squares() <= 1 + 1e-18L))
    throw InputError(fmt::format("spin^2 + charge^2 must be at most 1, got spin {} and charge {}",
                                 rounded(hole.spin), rounded(hole.charge)));
  const long double inner = place.hole.inner_horizon();
  if (!(r > inner && r <= 1e12L))
    throw InputError(
        fmt::format("r must be above the inner horizon, {:.9g}, and at most 1e12 "
                    "(units of M), got {}",
                    rounded(inner), rounded(r)));
  if (!(theta >= 0 && theta <= kHalfTurn * (1 + 1e-12L)))
    throw InputError(fmt::format("theta must be from 0 to pi, got {}", rounded(theta)));
  return place;
}

long double lost_digits(const std::string& text) {
  using Decimal = boost::multiprecision::cpp_dec_float_50;
  const Decimal rounded(std::strtold(text.c_str(), nullptr));
  return static_cast<long double>(Decimal(Decimal(text) - rounded));
}

KerrDirection kerr_direction(long double delta, long double eta) {
  // A decimal that is pi rounded up is taken as pi.
  if (!(delta >= 0 && delta <= kHalfTurn * (1 + 1e-12L)))
    throw InputError(fmt::format("delta must be from 0 to pi, got {}", rounded(delta)));
  return {std::min(delta, kHalfTurn), eta, {}, 0};
}

KerrDirection kerr_direction_at_edge(const KerrPlace& at, std::string_view edge, long double offset,
                                     long double eta) {
  if (edge != "silhouette" && edge != "region3")
    throw InputError(fmt::format("edge must be silhouette, region3 or empty, got '{}'", edge));
  if (edge == "region3" && !(at.delta() < 0))
    throw InputError("there is no edge region3 at this r");
  const KerrEdge which = edge == "silhouette" ? KerrEdge::kSilhouette : KerrEdge::kRegionThree;
  const KerrDirection direction{0, eta, which, offset};
  const long double delta = kerr_delta(at, direction);
  if (!(delta >= -1e-12L && delta <= kHalfTurn * (1 + 1e-12L)))
    throw InputError(fmt::format("offset must keep delta from 0 to pi, got {}", rounded(offset)));
  return direction;
}

long double kerr_delta(const KerrPlace& at, const KerrDirection& direction) {
  if (!direction.edge) return direction.delta;
  return critical_ray(at, direction.eta, *direction.edge).delta + direction.offset;
}

}  // namespace domefall
