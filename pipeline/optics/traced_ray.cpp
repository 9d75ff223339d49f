#include "pipeline/optics/traced_ray.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/silhouette.h"
#include "pipeline/optics/sky_table.h"

namespace domefall {
namespace {

// A ray in the rain frame, and omega_observer/omega_rain, which is also d delta_rain/d delta.
struct RainView {
  NullRay ray;
  double delta;  // in the observer's own frame
  double doppler;
};

RainView rain_view(const RayRequest& q) {
  const NullRay ray = q.edge ? ray_off_edge(q.at, *q.edge, q.offset) : ray_at(q.at, q.delta);
  return {ray, q.edge ? delta_of(ray) : q.delta, 1};
}

// The rain moves inward at s = sqrt(2/r): tan(delta_rain/2) = kappa tan(delta_static/2),
// kappa = sqrt((1-s)/(1+s)), and a gap to the edge scales the same way.
RainView static_view(const RayRequest& q) {
  const double s = std::sqrt(2 / q.at.r);
  const double kappa = std::sqrt(q.at.above_horizon / q.at.r) / (1 + s);
  const double edge_tangent = tan_half_silhouette(q.at) / kappa;
  const double edge = 2 * std::atan(edge_tangent);
  const double half_offset = (q.edge ? q.offset : q.delta - edge) / 2;
  const double delta = q.edge ? edge + q.offset : q.delta;
  const double sine = std::sin(delta / 2), cosine = std::sin((std::numbers::pi - delta) / 2);
  const double gap = std::sin(half_offset) * std::hypot(1, edge_tangent);
  const double norm = std::hypot(kappa * sine, cosine);
  return {{q.at, kappa * sine / norm, cosine / norm, kappa * gap / norm, 0},
          delta,
          kappa / (norm * norm)};
}

double distance(const NullRay& ray, Edge edge) {
  const bool outer = edge == Edge::kSilhouette;
  const double tangent = outer ? tan_half_silhouette(ray.at) : tan_half_region_three(ray.at);
  const double cos_edge = 1 / std::sqrt(1 + tangent * tangent);
  const double sine = std::abs(outer ? ray.gap_silhouette : ray.gap_three) * cos_edge;
  const double cosine = (ray.cos_half + ray.sin_half * tangent) * cos_edge;
  return 2 * sine / (1 + cosine);
}

// d phi/d delta of the exact integral by a four-point central difference in the distance to the
// edge.  phi is odd about the far end of a sky (delta = pi or 0), where the difference steps across.
// Measured against the reference: relative error below 1e-9.
double exact_slope(const Radius& at, Edge edge, double x) {
  const bool outer = edge == Edge::kSilhouette;
  const double sign = outer ? 1 : -1, h = 1e-3 * x;
  const double reach = outer ? 2 * std::atan2(1.0, tan_half_silhouette(at))
                             : 2 * std::atan(tan_half_region_three(at));
  const auto phi = [&](double k) {
    const double offset = 4 * std::atan((x + k * h) / 2);
    const double inside = offset <= reach ? offset : 2 * reach - offset;
    const double swept = exact_azimuth(ray_off_edge(at, edge, sign * inside));
    return offset <= reach ? swept : -swept;
  };
  const double by_x = (8 * (phi(1) - phi(-1)) - (phi(2) - phi(-2))) / (12 * h);
  return std::abs(by_x) * (1 + x * x / 4) / 2;
}

}  // namespace

TracedRay trace_ray(const RayRequest& q, TraceMethod method) {
  const RainView view = q.observer == TraceObserver::kRain ? rain_view(q) : static_view(q);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  TracedRay traced{view.delta, origin_of(view.ray), kNone, kNone, kNone, kNone};
  if (traced.origin == Origin::kPastSingularity) return traced;
  const Edge edge = traced.origin == Origin::kSkyOne ? Edge::kSilhouette : Edge::kRegionThree;
  const double x = distance(view.ray, edge);
  double slope = 0;
  if (method == TraceMethod::kTable) {
    const SkyTable table(q.at, edge);
    traced.phi = table.azimuth(x);
    slope = table.slope(x);
  } else {
    traced.phi = exact_azimuth(view.ray);
    slope = exact_slope(q.at, edge, x);
  }
  slope *= view.doppler;
  traced.slope = edge == Edge::kSilhouette ? -slope : slope;
  traced.one_plus_z = one_plus_z(view.ray) / view.doppler;
  // At the far end both sines vanish, and their ratio is 1/slope.
  const bool far_end = traced.phi < 1e-6;
  traced.amplification =
      far_end ? 1 / (slope * slope) : std::sin(view.delta) / std::abs(std::sin(traced.phi) * slope);
  return traced;
}

}  // namespace domefall
