#include "pipeline/light/wormhole_azimuth.h"

#include <algorithm>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>

#include "pipeline/light/wormhole_ray.h"

namespace domefall {
namespace {

using boost::math::ellint_rf;

// ---- ellis ----

double ellis_azimuth(const ThroatRay& ray, double l) {
  const double rises = ray.r * ray.cosine;
  const double leg = ray.b * ellint_rf(l * l, ray.r * ray.r, rises * rises);  // to infinity
  if (!ray.inward) return leg;
  const double whole = ray.passes ? ellint_rf(0.0, 1.0, ray.below * (1 + ray.b))
                                  : ellint_rf(0.0, -ray.below * (1 + ray.b), ray.b * ray.b);
  return 2 * ray.b * whole - leg;
}

// ---- dngr ----

// Returns the azimuth between two places of a leg.
double swept(const WormholeLeg& leg, double low, double high) {
  return along_leg(leg, low, high, [&leg](const WormholeLeg::Place& p) {
    return leg.impact() * p.rate / (p.r * p.r);
  });
}

double cylinder_part(const Wormhole& w, const ThroatRay& ray, double l) {
  const double a = w.half_length(), far = std::abs(l);
  double way = 0;
  if (w.in_cylinder(l))
    way = ray.passes ? a + far : a - far;
  else if (ray.passes)
    way = 2 * a;
  return way == 0 ? 0 : ray.b * way / std::sqrt(ray.below * (1 + ray.b));
}

double dngr_azimuth(const Wormhole& w, const ThroatRay& ray, double l) {
  constexpr double kLost = 40;  // exp(-40) is nothing
  const WormholeLeg leg(w, ray.b, ray.below);
  const double start = ray.start(leg, w.beyond_mouth(l));
  const double out =
      swept(leg, start, std::max(start, leg.calm()) + kLost) + cylinder_part(w, ray, l);
  return ray.inward ? out + 2 * swept(leg, 0, start) : out;
}

}  // namespace

EdgeAngle edge_angle(const Wormhole& w, double l) {
  const double above = w.above_throat(l), r = 1 + above;
  return {1 / r, std::sqrt(above) * std::sqrt(2 + above) / r};
}

ThroatRay throat_ray(const Wormhole& w, double l, double offset) {
  const EdgeAngle edge = edge_angle(w, l);
  const double r = w.radius(l), sine = std::sin(offset / 2), cosine = std::cos(offset / 2);
  ThroatRay ray{};
  ray.r = r;
  ray.b = r * (edge.sine * std::cos(offset) + edge.cosine * std::sin(offset));
  ray.below = -2 * r * sine * (edge.cosine * cosine - edge.sine * sine);
  ray.sine = ray.b / r;
  ray.cosine = edge.cosine * std::cos(offset) - edge.sine * std::sin(offset);
  ray.passes = offset < 0;
  ray.inward = ray.passes || ray.cosine > 0;
  return ray;
}

HalfAngle throat_edge(const Wormhole& wormhole, double l) {
  const EdgeAngle edge = edge_angle(wormhole, l);
  return half_angle(edge.cosine, edge.sine);
}

double cylinder_azimuth(const Wormhole& wormhole, double l, double offset) {
  return cylinder_part(wormhole, throat_ray(wormhole, l, offset), l);
}

double wormhole_azimuth(const Wormhole& wormhole, double l, double offset) {
  if (offset == 0) return std::numeric_limits<double>::infinity();
  const ThroatRay ray = throat_ray(wormhole, l, offset);
  return wormhole.profile == Wormhole::Profile::kEllis ? ellis_azimuth(ray, l)
                                                       : dngr_azimuth(wormhole, ray, l);
}

}  // namespace domefall
