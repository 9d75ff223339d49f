#include "pipeline/light/null_ray.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/half_angle.h"
#include "pipeline/light/silhouette.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// This is half of an angle near an edge, whose half-angle tangent is given.
struct HalfAngleOffEdge {
  double sine, cosine;
  double gap;  // sine - tangent * cosine, from the offset alone
};

HalfAngleOffEdge turned_from(double tangent, double half_offset) {
  const double c = 1 / std::sqrt(1 + tangent * tangent), s = tangent * c;
  const double so = std::sin(half_offset), co = std::cos(half_offset);
  return {s * co + c * so, c * co - s * so, so / c};
}

// Returns T_silhouette - |T_second|, from the quadratic of silhouette.h.  It is the sum of its
// roots inside, and their difference outside.
double edge_separation(const Radius& at) {
  const double s = Schwarzschild::free_fall_speed(at.r);
  if (at.above_horizon <= 0) return 2 * at.r / (Schwarzschild::kCriticalImpact * (1 + s));
  return -2 * at.above_light_circle * std::sqrt(1 + 6 / at.r) /
         (Schwarzschild::kCriticalImpact * (1 + s));
}

template <class Real>
Real kappa_of(const Radius& at, const RadialFrame& frame) {
  if (!frame.at_rest) return 1;
  const Real r = r_as<Real>(at), above = above_horizon_as<Real>(at);
  return std::sqrt(std::abs(above) / r) / (1 + Schwarzschild::free_fall_speed(r));
}

// Goes from half an angle in a frame to the ray, whose gap to `edge` is known there.
NullRay ray_from_frame(const Radius& at, const RadialFrame& frame, double sine, double cosine,
                       double gap, Critical edge) {
  const double k = kappa(at, frame), norm = std::hypot(k * sine, cosine);
  NullRay ray{at, 0, 0, 0, 0, frame.outgoing};
  // The far end of a sky (alpha = pi or 0) is an end that rounding may not step over.
  ray.sin_half = std::max(0.0, k * sine / norm);
  ray.cos_half = std::max(0.0, cosine / norm);
  const double own = k * gap / norm, apart = edge_separation(at) * ray.cos_half;
  const bool first = edge == Critical::kFirst;
  // The other gap follows by way of the exact distance between the two, or directly where that
  // cancels less.
  const Critical other = first ? Critical::kSecond : Critical::kFirst;
  const double reach = tan_half_critical(at, other) * ray.cos_half;
  const bool direct = std::max(ray.sin_half, reach) < std::max(std::abs(own), std::abs(apart));
  const double its = direct ? ray.sin_half - reach : first ? own + apart : own - apart;
  ray.gap_first = first ? own : its;
  ray.gap_second = first ? its : own;
  return ray;
}

// Returns k^r in the rain frame, inner ch^2 - (1 + s) sh^2 with inner = 1 - s.  Outside, that
// cancels at tan(alpha/2) = kappa = sqrt(T_first T_second), the turning point.  Near the light
// circle this lies as near to the critical rays as these to each other, and there its gap is made
// from theirs.
double rain_radial(const NullRay& ray, double s, double inner) {
  const double sh = ray.sin_half, ch = ray.cos_half;
  const double out = inner * ch * ch, in = (1 + s) * sh * sh;
  if (ray.at.above_horizon <= 0) return out - in;
  const double first = std::sqrt(tan_half_critical(ray.at, Critical::kFirst));
  const double second = std::sqrt(tan_half_critical(ray.at, Critical::kSecond));
  const double turning = -edge_separation(ray.at) * first / (first + second);  // kappa - T_first
  const double sum = (1 + s) * (sh + first * second * ch);
  // This is what is rounded in either form.  The smaller wins.
  const double by_gap = std::max(std::abs(ray.gap_first), std::abs(turning * ch)) * sum;
  if (std::max(out, in) < by_gap) return out - in;
  return -(ray.gap_first - turning * ch) * sum;
}

}  // namespace

double tan_half_critical(const Radius& at, Critical edge) {
  return edge == Critical::kFirst ? tan_half_silhouette(at) : std::abs(tan_half_other_root(at));
}

double kappa(const Radius& at, const RadialFrame& frame) { return kappa_of<double>(at, frame); }

NullRay ray_at(const Radius& at, const PolarAngle& alpha, const RadialFrame& frame) {
  const auto kappa = kappa_of<long double>(at, frame);
  const auto gap_from = [&](Critical edge) {
    const long double root = edge == Critical::kFirst ? tan_half_silhouette_long(at)
                                                      : std::abs(tan_half_other_root_long(at));
    const long double tangent = root / kappa;
    // The angle is taken from whichever end of the half turn is nearer.
    const long double half_offset = alpha.angle < alpha.rest
                                        ? alpha.angle / 2 - std::atan(tangent)
                                        : std::atan(1 / tangent) - alpha.rest / 2;
    return std::sin(static_cast<double>(half_offset)) * std::hypot(1, static_cast<double>(tangent));
  };
  const double one = gap_from(Critical::kFirst), two = gap_from(Critical::kSecond);
  const bool first = std::abs(one) <= std::abs(two);
  const double sine = std::sin(static_cast<double>(alpha.angle / 2));
  const double cosine = alpha.angle < alpha.rest ? std::cos(static_cast<double>(alpha.angle / 2))
                                                 : std::sin(static_cast<double>(alpha.rest / 2));
  return ray_from_frame(at, frame, sine, cosine, first ? one : two,
                        first ? Critical::kFirst : Critical::kSecond);
}

NullRay ray_at(const Radius& at, long double alpha, const RadialFrame& frame) {
  return ray_at(at, polar_angle(alpha), frame);
}

PolarAngle polar_angle(long double angle) {
  // This is pi, and what a long double leaves of it.
  constexpr long double kPi = std::numbers::pi_v<long double>, kRest = -5.01655761266833202e-20L;
  return {angle, (kPi - angle) + kRest};
}

NullRay ray_off_edge(const Radius& at, Critical edge, double offset, const RadialFrame& frame) {
  const HalfAngleOffEdge half =
      turned_from(tan_half_critical(at, edge) / kappa(at, frame), offset / 2);
  return ray_from_frame(at, frame, half.sine, half.cosine, half.gap, edge);
}

NullRay ray_of_tangent(const Radius& at, double tangent, bool outgoing) {
  const auto [sine, cosine] = half_angle_of_tangent(tangent);
  const double one = sine - tan_half_critical(at, Critical::kFirst) * cosine;
  const double two = sine - tan_half_critical(at, Critical::kSecond) * cosine;
  const bool first = std::abs(one) <= std::abs(two);
  return ray_from_frame(at, {outgoing, false}, sine, cosine, first ? one : two,
                        first ? Critical::kFirst : Critical::kSecond);
}

NullRay ray_of_ratio(const Radius& at, Critical edge, double excess, bool outgoing) {
  const double edge_tangent = tan_half_critical(at, edge);
  const auto [sine, cosine] = half_angle_of_tangent(edge_tangent * (1 + excess));
  return ray_from_frame(at, {outgoing, false}, sine, cosine, edge_tangent * excess * cosine, edge);
}

NullRay turned(const NullRay& ray, double angle) {
  const double s = std::sin(angle / 2), c = std::cos(angle / 2);
  NullRay out = ray;
  out.sin_half = ray.sin_half * c + ray.cos_half * s;
  out.cos_half = ray.cos_half * c - ray.sin_half * s;
  const auto gap = [&](double before, Critical edge) {
    return before * c + (ray.cos_half + tan_half_critical(ray.at, edge) * ray.sin_half) * s;
  };
  out.gap_first = gap(ray.gap_first, Critical::kFirst);
  out.gap_second = gap(ray.gap_second, Critical::kSecond);
  return out;
}

double alpha_of(const NullRay& ray) { return 2 * std::atan2(ray.sin_half, ray.cos_half); }

SkyRegion origin_of(const NullRay& ray) {
  const bool outside = ray.at.above_horizon > 0;
  if (ray.outgoing) return outside && ray.gap_second < 0 ? SkyRegion::kI : SkyRegion::kIV;
  if (ray.gap_first > 0) return SkyRegion::kI;
  if (ray.at.above_horizon < 0 && ray.gap_second < 0) return SkyRegion::kIII;
  return SkyRegion::kIV;
}

bool circles_for_ever(const NullRay& ray) {
  if (ray.outgoing) return ray.at.above_horizon > 0 && ray.gap_second == 0;
  return ray.gap_first == 0 || (ray.at.above_horizon < 0 && ray.gap_second == 0);
}

RayInvariants invariants(const NullRay& ray) {
  const double r = ray.at.r, sh = ray.sin_half, ch = ray.cos_half;
  const double s = Schwarzschild::free_fall_speed(r);
  const bool outside = ray.at.above_horizon > 0;
  const double inner = Schwarzschild::below_light_speed(ray.at);
  const double silhouette = tan_half_silhouette(ray.at);
  const double second = tan_half_critical(ray.at, Critical::kSecond);
  // The roots of E = L/sqrt 27 are T_silhouette and +-T_second.  The sign is + outside, where both
  // edges are of this kind, and - inside, where the second is that of E = -L/sqrt 27.
  RayInvariants k;
  k.below_critical = (1 + s) * ray.gap_first * (outside ? ray.gap_second : sh + second * ch);
  k.above_critical =
      (1 + s) * (sh + silhouette * ch) * (outside ? sh + second * ch : ray.gap_second);
  // Inside, where the direct form cancels, both factors have E's own sign.
  k.energy =
      outside ? (1 + s) * sh * sh + inner * ch * ch : (k.below_critical + k.above_critical) / 2;
  k.angular_momentum = 2 * r * sh * ch;
  k.radial = rain_radial(ray, s, inner);
  if (ray.outgoing) k.radial = -k.radial;
  return k;
}

double one_plus_z(const NullRay& ray) { return std::abs(invariants(ray).energy); }

}  // namespace domefall
