#include "pipeline/light/wormhole_azimuth.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>

#include "pipeline/spacetime/wormhole_leg.h"

namespace domefall {
namespace {

using boost::math::ellint_rf;

// The throat's view has this angle.  Its cosine vanishes at the throat and keeps its digits there.
struct EdgeAngle {
  double sine, cosine;
};

EdgeAngle edge_angle(const Wormhole& w, double l) {
  const double above = w.above_throat(l), r = 1 + above;
  return {1 / r, std::sqrt(above) * std::sqrt(2 + above) / r};
}

struct ThroatRay {
  double r;             // of the observer
  double b, below;      // b and 1 - b
  double cosine;        // of delta
  bool inward, passes;  // towards the throat at first; through it
};

ThroatRay throat_ray(const Wormhole& w, double l, double offset) {
  const EdgeAngle edge = edge_angle(w, l);
  const double r = w.radius(l), sine = std::sin(offset / 2), cosine = std::cos(offset / 2);
  ThroatRay ray{};
  ray.r = r;
  ray.b = r * (edge.sine * std::cos(offset) + edge.cosine * std::sin(offset));
  ray.below = -2 * r * sine * (edge.cosine * cosine - edge.sine * sine);
  ray.cosine = edge.cosine * std::cos(offset) - edge.sine * std::sin(offset);
  ray.passes = offset < 0;
  ray.inward = ray.passes || ray.cosine > 0;
  return ray;
}

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

using LegRule = boost::math::quadrature::gauss<double, 20>;
constexpr double kLegPanel = 2.5;  // of u; 20 nodes integrate to rounding what is smooth over pi/2

// Returns the azimuth between two places of a leg in which the integrand is smooth.
double swept(const WormholeLeg& leg, double from, double to) {
  const auto rate = [&leg](double u) {
    const WormholeLeg::Place p = leg.at(u);
    return leg.impact() * p.rate / (p.r * p.r);
  };
  return LegRule::integrate(rate, from, to);
}

double swept_to(const WormholeLeg& leg, double start) {
  const double panels = std::ceil(start / kLegPanel);
  double sum = 0;
  for (double k = 0; k < panels; ++k)
    sum += swept(leg, start * (k / panels), start * ((k + 1) / panels));
  return sum;
}

// Where the integrand is as good as exp(-u) the panels grow.
double swept_beyond(const WormholeLeg& leg, double start) {
  constexpr double kLost = 40;     // exp(-40) is nothing
  constexpr double kGrowth = 2.2;  // three panels more
  const double calm = leg.calm(), end = std::max(start, calm) + kLost;
  double sum = 0, width = kLegPanel;
  for (double u = start; u < end; u += width) {
    if (u > calm + kLegPanel) width *= kGrowth;
    sum += swept(leg, u, u + width);
  }
  return sum;
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
  const WormholeLeg leg(w, ray.b, ray.below);
  // r - b = r (1 - sin(delta)) does not cancel this way.
  const double start =
      leg.parameter(w.beyond_mouth(l), ray.r * ray.cosine * ray.cosine / (1 + ray.b / ray.r));
  const double out = swept_beyond(leg, start) + cylinder_part(w, ray, l);
  return ray.inward && start > 0 ? out + 2 * swept_to(leg, start) : out;
}

}  // namespace

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
