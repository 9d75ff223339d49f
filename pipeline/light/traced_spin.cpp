#include "pipeline/light/traced_spin.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/errors.h"
#include "pipeline/light/kerr_ray.h"
#include "pipeline/light/kerr_request.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_charge.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Throws InputError unless a delta that is given with an edge is the edge's plus the offset.
void require_same_delta(const SpinRay& ray, long double own) {
  const long double offset = ray.offset.value_or(0);
  if (ray.delta) require_delta(*ray.delta, own - offset, offset);
}

long double delta_of(const SpinRay& ray) {
  if (ray.offset) throw InputError("offset is given without an edge");
  if (!ray.delta) throw InputError("a ray takes delta, or an edge and perhaps an offset from it");
  return *ray.delta;
}

ChargedRequest charged_question(const SpinRay& ray) {
  const auto theta = static_cast<double>(ray.theta);
  if (!(theta >= 0 && theta <= pi))
    throw InputError(fmt::format("theta must be from 0 to pi, got {}", theta));
  if (ray.edge.empty()) return charged_ray_at_angle(ray.hole.charge, ray.r, delta_of(ray));
  const ChargedRequest request = charged_ray_at_edge(ray.hole.charge, ray.r, ray.edge,
                                                     static_cast<double>(ray.offset.value_or(0)));
  require_same_delta(ray, request.delta);
  return request;
}

void require_edge(const std::string& edge) {
  if (edge != "silhouette" && edge != "region3")
    throw InputError(fmt::format("edge must be silhouette, region3 or empty, got '{}'", edge));
}

// A SweptPlane is the plane of a ray about the hole.  The place on the sky that light came from is
// cos(phi) n - sin(phi) e, with n the observer's place and e the light's direction across it.
struct SweptPlane {
  V3d n, e;

  SweptPlane(double theta, double eta)
      : n(std::sin(theta), 0, std::cos(theta)),
        e(std::cos(eta) * std::cos(theta), std::sin(eta), -std::cos(eta) * std::sin(theta)) {}
  V3d place(double phi) const { return n * std::cos(phi) - e * std::sin(phi); }
  // Returns how often z is extreme on the way there.
  int turns(double phi) const {
    double first = std::atan2(-e.z, n.z);
    if (first <= 0) first += pi;
    return phi > first ? 1 + static_cast<int>((phi - first) / pi) : 0;
  }
};

// Returns the names of an origin, and of what the light of the past horizon came from.
std::array<std::string_view, 2> names_of(const TracedCharge& ray, const ChargedHole& hole) {
  switch (ray.origin) {
    case ChargedOrigin::kOwn:
      return {"I", ""};
    case ChargedOrigin::kParallel:
      return {"III", ""};
    case ChargedOrigin::kBefore:
    case ChargedOrigin::kParallelBefore:
      return {"H", "E"};
    case ChargedOrigin::kDark:
      break;
  }
  if (hole.is_naked()) return {"B", ""};
  return {"H", hole.charge == 0 ? "S" : "B"};
}

TracedSpinRay trace_without_spin(const SpinRay& asked) {
  const ChargedRequest request = charged_question(asked);
  const TracedCharge ray = trace_charge(request);
  const auto [origin, beyond] = names_of(ray, request.hole);
  TracedSpinRay out{origin, beyond, std::abs(ray.energy)};
  if (ray.origin == ChargedOrigin::kDark) return out;
  const SweptPlane plane(static_cast<double>(asked.theta), static_cast<double>(asked.eta));
  out.sky = plane.place(ray.phi);
  out.amplification = ray.amplification;
  out.turns = plane.turns(ray.phi);
  // On the axis phi = L/(r |E|), if the light came straight.
  out.mino = ray.angular_momentum > 0 ? ray.phi / ray.angular_momentum
                                      : 1 / (request.at.r * std::abs(ray.energy));
  return out;
}

}  // namespace

std::optional<KerrQuestion> kerr_question(const SpinRay& ray) {
  if (ray.hole.spin != 0 && ray.r <= ray.hole.inner_horizon()) {
    constexpr long double kOutside = 3;
    kerr_place(ray.hole, kOutside, ray.theta);
    if (ray.edge.empty())
      kerr_direction(delta_of(ray), ray.eta);
    else
      require_edge(ray.edge);
    return std::nullopt;
  }
  KerrQuestion question{kerr_place(ray.hole, ray.r, ray.theta), {}};
  if (ray.edge.empty()) {
    question.direction = kerr_direction(delta_of(ray), ray.eta);
    return question;
  }
  question.direction =
      kerr_direction_at_edge(question.at, ray.edge, ray.offset.value_or(0), ray.eta);
  require_same_delta(ray, kerr_delta(question.at, question.direction));
  return question;
}

TracedSpinRay trace_spin_ray(const SpinRay& asked) {
  if (asked.hole.spin == 0) return trace_without_spin(asked);
  const std::optional<KerrQuestion> question = kerr_question(asked);
  if (!question) return {};
  const TracedKerr ray = trace_kerr(question->at, question->direction);
  if (ray.origin == KerrOrigin::kPastHorizon) return {"H", "", std::abs(ray.energy)};
  return {ray.origin == KerrOrigin::kOwn ? "I" : "III",
          "",
          std::abs(ray.energy),
          ray.sky,
          ray.amplification,
          ray.mino,
          ray.turns};
}

}  // namespace domefall
