#include "pipeline/light/wormhole_azimuth.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace domefall {
namespace {

using boost::math::ellint_rf;
using std::numbers::pi;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

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

// A Leg is the way between the mouth, or the place where the ray turns, and infinity, along u.
struct Leg {
  double m, unit;  // y = unit x
  double b, below;
  double turn;   // x_t, or 0
  double scale;  // s, without a turn
  double start;  // u of the observer
  double calm;   // u beyond which only the way to infinity is left

  double operator()(double u) const {
    if (turn > 0) {
      const double half = std::sinh(u / 2);
      const double risen = m * flare_growth(turn, 2 * turn * half * half);  // r - b
      const double r = b + risen;
      return b * unit * turn * std::sinh(u) / (r * std::sqrt(risen * (r + b)));
    }
    const double risen = m * flare(scale * std::sinh(u) / unit), r = 1 + risen;
    return b * scale * std::cosh(u) / (r * std::sqrt((below + risen) * (r + b)));
  }
};

// Returns the way between the observer's x and the turn's, where both are given, so that it keeps
// its digits next to the turn: G(x) - G(x - way) = growth.
double way_from_turn(double x, double turn, double growth) {
  const double plain = x - turn;
  if (plain > x / 4) return plain;
  double way = growth / std::atan(x);
  for (int k = 0; k < 8; ++k) way -= (flare_growth(x - way, way) - growth) / std::atan(x - way);
  return way;
}

Leg leg_of(const Wormhole& w, const ThroatRay& ray, double l) {
  Leg leg{};
  leg.m = w.lensing_mass(), leg.unit = pi / 2 * leg.m;
  leg.b = ray.b, leg.below = ray.below;
  const double y = w.beyond_mouth(l), widest = std::max(1.0, leg.unit);
  if (ray.below < 0) {
    leg.turn = flare_inverse(-ray.below / leg.m);
    const double growth = ray.r * ray.cosine * ray.cosine / ((1 + ray.b / ray.r) * leg.m);
    const double way = way_from_turn(y / leg.unit, leg.turn, growth);
    leg.start = 2 * std::asinh(std::sqrt(way / (2 * leg.turn)));
    leg.calm = std::acosh(1 + widest / (leg.unit * leg.turn));
    return leg;
  }
  // r - b vanishes at the imaginary y near pi sqrt(m (1 - b)/2) or near m pi/2, where the flare is
  // singular.  In u both are at least pi/2 away.  An outward ray may have b = 1.
  const double below = std::max(ray.below, 1e-300);
  leg.scale = 0.9 * leg.unit * std::min(1.0, std::sqrt(2 * below / leg.m));
  leg.start = std::asinh(y / leg.scale);
  leg.calm = std::asinh(widest / leg.scale);
  return leg;
}

using Rule = boost::math::quadrature::gauss<double, 20>;
constexpr double kPanel = 2.5;  // of u; 20 nodes integrate to rounding what is smooth over pi/2

double sum_to_start(const Leg& leg) {
  const double panels = std::ceil(leg.start / kPanel);
  double sum = 0;
  for (double k = 0; k < panels; ++k)
    sum += Rule::integrate(leg, leg.start * (k / panels), leg.start * ((k + 1) / panels));
  return sum;
}

// Where the integrand is as good as exp(-u) the panels grow.
double sum_beyond_start(const Leg& leg) {
  constexpr double kLost = 40;  // exp(-40) is nothing
  const double end = std::max(leg.start, leg.calm) + kLost;
  double sum = 0, width = kPanel;
  for (double u = leg.start; u < end; u += width) {
    if (u > leg.calm + kPanel) width = std::min(2 * width, 6 * kPanel);
    sum += Rule::integrate(leg, u, u + width);
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
  const Leg leg = leg_of(w, ray, l);
  const double out = sum_beyond_start(leg);
  if (!ray.inward || leg.start == 0) return out + cylinder_part(w, ray, l);
  return out + 2 * sum_to_start(leg) + cylinder_part(w, ray, l);
}

}  // namespace

HalfAngle throat_edge(const Wormhole& wormhole, double l) {
  const EdgeAngle edge = edge_angle(wormhole, l);
  return half_angle(edge.cosine, edge.sine);
}

double wormhole_azimuth(const Wormhole& wormhole, double l, double offset) {
  if (offset == 0) return kInfinite;
  const ThroatRay ray = throat_ray(wormhole, l, offset);
  return wormhole.profile == Wormhole::Profile::kEllis ? ellis_azimuth(ray, l)
                                                       : dngr_azimuth(wormhole, ray, l);
}

double cylinder_azimuth(const Wormhole& wormhole, double l, double offset) {
  return cylinder_part(wormhole, throat_ray(wormhole, l, offset), l);
}

}  // namespace domefall
