#include "pipeline/report/ray_methods.h"

#include <array>
#include <cmath>

#include "pipeline/optics/integrated_ray.h"

namespace domefall {
namespace {

// [Riazuelo] eq. def_k_prec and TR_IV, as reference_ray.h has them.
PhotonAtObserver photon_of(const RayRequest& q) {
  const double r = q.at.r;
  const double delta =
      q.edge ? edge_delta(q.observer, q.at, *q.edge) + q.offset : static_cast<double>(q.delta);
  const double c = std::cos(delta), l = r * std::sin(delta), s = std::sqrt(2 / r);
  const double at_rest = std::sqrt(std::abs(q.at.above_horizon) / r);
  const bool inside = q.at.above_horizon <= 0;
  switch (q.observer) {
    case TraceObserver::kStatic:
      return {Region::kI, r, at_rest, l, at_rest * c};
    case TraceObserver::kOutgoing:
      return {inside ? Region::kIV : Region::kI, r, 1 + s * c, l, c + s};
    case TraceObserver::kTwo:
      return {Region::kII, r, -at_rest * c, l, -at_rest};
    case TraceObserver::kFour:
      return {Region::kIV, r, -at_rest * c, l, at_rest};
    case TraceObserver::kRain:
      break;
  }
  return {inside ? Region::kII : Region::kI, r, 1 - s * c, l, c - s};
}

std::optional<Origin> origin_of(RayEnd end) {
  switch (end) {
    case RayEnd::kSkyOne:
      return Origin::kSkyOne;
    case RayEnd::kSkyThree:
      return Origin::kSkyThree;
    case RayEnd::kPastSingularity:
      return Origin::kPastSingularity;
    case RayEnd::kUndecided:
      break;
  }
  return std::nullopt;
}

FollowedRay by_table(const RayRequest& q, double bits) {
  TraceOptions options;
  options.table_bits = static_cast<int>(bits);
  const TracedRay ray = trace_ray(q, TraceMethod::kTable, options);
  return {ray.origin, ray.phi};
}

FollowedRay by_integral(const RayRequest& q, double) {
  const TracedRay ray = trace_ray(q, TraceMethod::kExact);
  return {ray.origin, ray.phi};
}

std::vector<double> table_bits(bool quick) {
  constexpr int kDefault = OctaveCurve::kPerOctaveBits;
  if (quick) return {1, kDefault};
  return {0, 1, 2, kDefault, kDefault + 1, kDefault + 2};
}

constexpr double kDefaultTolerance = 1e-9;

std::vector<double> tolerances(bool quick) {
  if (quick) return {1e-5, kDefaultTolerance};
  return {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, kDefaultTolerance, 1e-10, 1e-11, 1e-12, 1e-13};
}

struct NamedIntegrator {
  const char* name;
  Integrator integrator;
};
constexpr std::array kIntegrators{NamedIntegrator{"paper-rk4", Integrator::kPaperRk4},
                                  NamedIntegrator{"full-dopri5", Integrator::kFullDopri5},
                                  NamedIntegrator{"full-rkf78", Integrator::kFullRkf78},
                                  NamedIntegrator{"binet-dopri5", Integrator::kBinetDopri5},
                                  NamedIntegrator{"binet-rkf78", Integrator::kBinetRkf78}};

}  // namespace

std::vector<RayMethod> ray_methods(bool quick) {
  std::vector<RayMethod> methods{
      {"table", "bits", table_bits(quick), OctaveCurve::kPerOctaveBits, true, false, by_table},
      {"exact", "", {0}, 0, false, false, by_integral}};
  for (const auto& [name, integrator] : kIntegrators)
    methods.push_back({name, "tolerance", tolerances(quick), kDefaultTolerance, false, true,
                       [integrator](const RayRequest& q, double tolerance) {
                         const IntegratedRay ray =
                             integrate_ray(photon_of(q), integrator, tolerance);
                         return FollowedRay{origin_of(ray.end), ray.phi};
                       }});
  return methods;
}

}  // namespace domefall
