#include "pipeline/light/ray_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

constexpr std::array<std::pair<std::string_view, TraceObserver>, 5> kObserverNames{
    {{"rain", TraceObserver::kRain},
     {"static", TraceObserver::kStatic},
     {"outgoing", TraceObserver::kOutgoing},
     {"T_II", TraceObserver::kTwo},
     {"T_IV", TraceObserver::kFour}}};

void require_place(TraceObserver observer, const Radius& at) {
  // NaN passes none of these comparisons.
  if (!(at.r >= 1e-9 && at.r <= 1e12))
    throw InputError(fmt::format("r must be from 1e-9 to 1e12 (units of M), got {}", at.r));
  if (observer == TraceObserver::kStatic && !(at.above_horizon > 0))
    throw InputError(
        fmt::format("r must exceed 2 (units of M) for a static observer, got {}", at.r));
  const bool inside = observer == TraceObserver::kTwo || observer == TraceObserver::kFour;
  if (inside && !(at.above_horizon < 0))
    throw InputError(fmt::format(
        "r must be below 2 (units of M) for the observers T_II and T_IV, got {}", at.r));
}

}  // namespace

TraceObserver trace_observer(std::string_view name) {
  for (const auto& [known, observer] : kObserverNames)
    if (name == known) return observer;
  throw InputError(
      fmt::format("observer must be rain, static, outgoing, T_II or T_IV, got '{}'", name));
}

TraceMethod trace_method(std::string_view name) {
  std::string names;
  for (const auto& [known, method] : kTraceMethods) {
    if (name == known) return method;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw InputError(fmt::format("method must be one of {}, got '{}'", names, name));
}

long double decimal_number(const std::string& text, const char* name) {
  char* end = nullptr;
  const long double value = std::strtold(text.c_str(), &end);
  const bool decimal = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
  if (text.empty() || !decimal || *end != 0 || !std::isfinite(value))
    throw InputError(fmt::format("{} must be a number, got '{}'", name, text));
  return value;
}

Radius decimal_radius(const std::string& text) {
  // What has too large an exponent for the exact number is refused by require_place.
  const long double rounded = decimal_number(text, "r");
  if (!(rounded >= 1e-10L && rounded <= 1e13L)) return Radius(static_cast<double>(rounded));
  using Decimal = boost::multiprecision::cpp_dec_float_50;
  const Decimal exact(text);
  return {static_cast<double>(exact), static_cast<double>(Decimal(exact - 2)),
          static_cast<double>(Decimal(exact - 3))};
}

RayRequest ray_at_angle(TraceObserver observer, const Radius& at, long double delta) {
  require_place(observer, at);
  // A decimal that is pi rounded up is taken as pi.
  constexpr long double kPi = std::numbers::pi_v<long double>;
  if (!(delta >= 0 && delta <= kPi * (1 + 1e-12L)))
    throw InputError(fmt::format("delta must be from 0 to pi, got {}", delta));
  RayRequest q;
  q.observer = observer;
  q.at = at;
  q.delta = std::min(delta, kPi);
  return q;
}

RayRequest ray_at_edge(TraceObserver observer, const Radius& at, std::string_view edge,
                       double offset) {
  require_place(observer, at);
  if (edge != "silhouette" && edge != "region3")
    throw InputError(fmt::format("edge must be silhouette, region3 or empty, got '{}'", edge));
  RayRequest q;
  q.observer = observer;
  q.at = at;
  q.edge = edge == "silhouette" ? Edge::kSilhouette : Edge::kRegionThree;
  if (!has_edge(observer, at, *q.edge))
    throw InputError(fmt::format("this observer sees no edge {} at this r", edge));
  q.offset = offset;
  const double place = edge_delta(observer, at, *q.edge);
  if (!(offset >= -place * (1 + 1e-12) && offset <= (M_PI - place) * (1 + 1e-12)))
    throw InputError(fmt::format("offset must keep delta from 0 to pi, got {}", offset));
  return q;
}

void require_delta(long double delta, long double edge, long double offset) {
  const long double own = edge + offset;
  if (!(std::abs(delta - own) <= 1e-9L * (edge + std::abs(offset))))
    throw InputError(fmt::format("delta is {}, and edge and offset give {}; leave one of them out",
                                 static_cast<double>(delta), static_cast<double>(own)));
}

void require_delta(const RayRequest& at_edge, long double delta) {
  require_delta(delta, edge_delta(at_edge.observer, at_edge.at, at_edge.edge.value()),
                at_edge.offset);
}

}  // namespace domefall
