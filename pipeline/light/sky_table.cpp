#include "pipeline/light/sky_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"

namespace domefall {
namespace {

// The law takes over here, in units of the smallest angle of the scene, and never below the second
// value.  That matters only where the light circle is nearer to the observer than 1e-8.
constexpr double kInnermost = 1e-7, kLeast = 1e-15;

// Returns the smallest angle, which is that from the edge to the axis either way, between the two
// critical rays, or 1.  At r = 3 those are one.
double smallest_angle(const Radius& at, double tangent) {
  const double to_axis = 2 * std::atan(std::min(tangent, 1 / tangent));
  const double apart =
      std::abs(tan_half_critical(at, Critical::kFirst) - tan_half_critical(at, Critical::kSecond));
  const double least = kLeast / kInnermost;
  return std::min({1.0, to_axis, apart > 0 ? std::max(apart, least) : 1.0});
}

}  // namespace

EdgeLaw fit_edge_law(double x_min, const std::function<double(double)>& phi) {
  // Here g = phi + ln z = c + z (a + b ln z) at z = 1, 1/4, 1/16.
  const double l = std::log(4.0);
  const double g1 = phi(x_min), g2 = phi(x_min / 4) - l, g3 = phi(x_min / 16) - 2 * l;
  EdgeLaw law{x_min, 0, 0, 0};
  law.a = 8 * (g1 + g2 - 2 * g3) / 9;
  law.b = 4 * (g1 - g2 - 0.75 * law.a) / l;
  law.c = g1 - law.a;
  return law;
}

double EdgeLaw::distance(double phi) const {
  // In z = exp(c - phi + z (a + b ln z)) the last term is below 1e-5, so a few rounds settle it.
  double z = std::exp(c - phi);
  for (int k = 0; k < 8 && z > 0; ++k) z = std::exp(c - phi + z * (a + b * std::log(z)));
  return z * x_min;
}

SkyEdge::SkyEdge(const Radius& at, Critical edge)
    : half(half_angle_of_tangent(tan_half_critical(at, edge))),
      sign(edge == Critical::kFirst ? 1 : -1) {}

SkyTable::SkyTable(const Radius& at, Critical edge, bool outgoing, int bits)
    : SkyTable(at, edge, outgoing, tan_half_critical(at, edge), bits) {}

SkyTable::SkyTable(const Radius& at, Critical edge, bool outgoing, double tangent, int bits)
    : at_(at),
      critical_(edge),
      outgoing_(outgoing),
      edge_(at, edge),
      edge_angle_(2 * std::atan(tangent)),
      // pi - edge is 2 acot(tangent), which is no difference of close numbers when the edge is near
      // pi.
      reach_(edge_.sign > 0 ? 2 * std::atan2(1.0, tangent) : edge_angle_),
      x_max_(2 * std::tan(reach_ / 4)),
      curve_(
          std::min(kInnermost * smallest_angle(at, tangent), x_max_ / 4), x_max_,
          [this](double x) { return continued_azimuth(x); },
          // In the outgoing frame E = 0, a branch point of phi, comes close in the complex plane.
          outgoing ? bits + 1 : bits),
      law_(fit_edge_law(curve_.x_min(), [this](double x) { return continued_azimuth(x); })) {}

NullRay SkyTable::ray_at_distance(double x) const {
  return ray_off_edge(at_, critical_, edge_.sign * std::min(4 * std::atan(x / 2), reach_),
                      {outgoing_, false});
}

// Returns phi continued oddly through the end of the sky (alpha = pi or 0), so that the last
// interval may reach beyond it.
double SkyTable::continued_azimuth(double x) const {
  const double offset = 4 * std::atan(x / 2);
  const double inside = offset <= reach_ ? offset : 2 * reach_ - offset;
  const double phi =
      exact_azimuth(ray_off_edge(at_, critical_, edge_.sign * inside, {outgoing_, false}));
  return offset <= reach_ ? phi : -phi;
}

double SkyTable::slope(double x) const {
  const double by_x = x < curve_.x_min() ? law_.slope(x) : curve_.at(x).first;
  return std::abs(by_x) * (1 + x * x / 4) / 2;
}

double SkyTable::distance(double phi) const {
  if (phi <= 0) return x_max_;
  if (phi > law_.azimuth(law_.x_min)) return law_.distance(phi);
  return std::min(curve_.inverse(phi, x_max_), x_max_);
}

double SkyTable::distance_of(const NullRay& ray) const {
  const double gap = critical_ == Critical::kFirst ? ray.gap_first : ray.gap_second;
  const double cosine = ray.cos_half * edge_.half.cosine + ray.sin_half * edge_.half.sine;
  return 2 * edge_.sign * gap * edge_.half.cosine / (1 + cosine);
}

}  // namespace domefall
