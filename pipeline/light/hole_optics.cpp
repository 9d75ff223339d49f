#include "pipeline/light/hole_optics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

using std::numbers::pi;

// An Order holds the azimuth from R at which light of the k-th order started, for a source at
// azimuth phi_star, and the side of the hole on which it is seen.
struct Order {
  double phi;
  double side;  // +1: towards the source
};

Order order_of(double phi_star, int k) {
  const bool same_side = k % 2 == 0;
  return {same_side ? phi_star + k * pi : (k + 1) * pi - phi_star, same_side ? 1.0 : -1.0};
}

double sine_of(const V3d& source) { return std::hypot(source.y, source.z); }

// Returns the unit vector across R towards the source, or any one if the source is on the axis.
V3d across(const V3d& source, double sine) {
  return sine > 0 ? V3d(0, source.y, source.z) / sine : V3d(0, 1, 0);
}

// Near a fold phi = phi_0 + c (alpha - alpha_0)^2/2, a source of radius rho is no narrower than
// sqrt(2 rho/c), and its slope is no less than sqrt(2 rho c).
double least_slope(double curvature, double blur) { return std::sqrt(2 * blur * curvature); }

// alpha counts from -R, or from R where inward is -1.
TetradDirection tetrad_direction(const ZoneRay& ray, double inward, const V3d& e) {
  return {V3d(-inward * ray.cosine(), 0, 0) + e * ray.sine()};
}

}  // namespace

const SkyTable* HoleOptics::table_of(SkyRegion sky) const {
  const auto tables = tables_of(sky);
  return tables.empty() ? nullptr : tables.front();
}

std::vector<const SkyTable*> HoleOptics::tables_of(SkyRegion sky) const {
  std::vector<const SkyTable*> tables;
  for (const SkyPart& part : parts)
    if (part.sky == sky && part.table) tables.push_back(&*part.table);
  return tables;
}

HoleOptics make_hole_optics(const Radius& at, Tetrad tetrad, WantedSkies wanted) {
  HoleOptics optics;
  optics.at = at;
  optics.tetrad = tetrad;
  if (std::isinf(at.r)) return optics;
  const bool outgoing = is_outgoing(tetrad);
  optics.energy = {1 + Schwarzschild::free_fall_speed(at.r), Schwarzschild::below_light_speed(at)};
  optics.inward = outgoing ? -1 : 1;
  const SkyRegion own = own_sky(tetrad, 0), other = own_sky(mirror_of(tetrad), 0);
  if (at.above_horizon > 0 || !outgoing) {
    const Critical edge = outgoing ? Critical::kSecond : Critical::kFirst;
    optics.parts.push_back({own, schwarzschild_zone(at, edge, outgoing), {}});
  }
  if (at.above_horizon < 0 && !outgoing)
    optics.parts.push_back({other, schwarzschild_zone(at, Critical::kSecond), {}});
  add_tables(optics, wanted);
  return optics;
}

void add_tables(HoleOptics& optics, WantedSkies wanted) {
  for (SkyPart& part : optics.parts)
    if (wanted.sky[part.sky] && !part.table) part.table.emplace(part.zone, optics.table_bits);
  if (wanted.sky[SkyRegion::kIV] && !optics.white_hole && !std::isinf(optics.at.r))
    optics.white_hole.emplace(optics.at, is_outgoing(optics.tetrad), optics.table_bits);
  if (wanted.emission_times && !optics.emission_times && optics.white_hole)
    optics.emission_times.emplace(*optics.white_hole, optics.table_bits);
}

bool lacks_tables(const HoleOptics& optics, const WantedSkies& wanted) {
  for (const SkyPart& part : optics.parts)
    if (wanted.sky[part.sky] && !part.table) return true;
  return (wanted.sky[SkyRegion::kIV] && !optics.white_hole) ||
         (wanted.emission_times && !optics.emission_times);
}

int table_count(const HoleOptics& optics) {
  int count = int{optics.white_hole.has_value()} + int{optics.emission_times.has_value()};
  for (const SkyPart& part : optics.parts) count += int{part.table.has_value()};
  return count;
}

std::size_t node_count(const HoleOptics& optics) {
  std::size_t count = (optics.white_hole ? optics.white_hole->node_count() : 0) +
                      (optics.emission_times ? optics.emission_times->node_count() : 0);
  for (const SkyPart& part : optics.parts) count += part.table ? part.table->node_count() : 0;
  return count;
}

SkyImage image_of(const SkyTable* table, const V3d& source, int order, double axis_blur) {
  if (table == nullptr) return {{source}, 1, 1};
  const double sine = sine_of(source);
  const Order o = order_of(std::atan2(sine, source.x), order);
  const double x = table->distance(o.phi);
  const ZoneRay ray = table->ray_at_distance(x);
  SkyImage image{};
  image.direction = tetrad_direction(ray, table->zone().inward, across(source, sine) * o.side);
  image.frequency_ratio = 1 / ray.one_plus_z;
  if (o.phi > table->most_azimuth()) return image;
  // At the far end, where sin(alpha) and sin(phi) vanish together, their ratio is 1/slope.
  const double slope = std::hypot(table->slope(x), least_slope(table->curvature(), axis_blur));
  const double on_axis = 1e-6 * std::min(1.0, table->most_azimuth());
  const bool far_end = order == 0 && o.phi < on_axis;
  image.amplification =
      far_end ? 1 / (slope * slope) : ray.sine() / (std::hypot(sine, axis_blur) * slope);
  return image;
}

WhiteHoleImages images_of(const WhiteHoleTable& table, const V3d& source, int order,
                          double axis_blur) {
  const double sine = sine_of(source);
  const Order o = order_of(std::atan2(sine, source.x), order);
  const WhiteHoleTable::Branches branches = table.rays_of(o.phi);
  const double least = table.turn() ? least_slope(std::abs(table.turn()->curvature), axis_blur) : 0;
  WhiteHoleImages images;
  images.count = branches.count;
  for (int k = 0; k < images.count; ++k) {
    const NullRay& ray = branches.ray[static_cast<std::size_t>(k)];
    SkyImage& image = images.image[static_cast<std::size_t>(k)];
    const ZoneRay seen{{ray.sin_half, ray.cos_half}, 1};
    const double sin_alpha = seen.sine();
    image.direction = tetrad_direction(seen, ray.outgoing ? -1 : 1, across(source, sine) * o.side);
    image.frequency_ratio = 1;
    const double slope = table.slope(table.place_of(ray));
    image.amplification =
        sin_alpha > 0 ? sin_alpha / (std::hypot(sine, axis_blur) * std::hypot(slope, least)) : 0;
  }
  return images;
}

TetradDirection primary_image(const HoleOptics& optics, const V3d& source) {
  const SkyZone& zone = optics.parts.front().zone;
  const double sine = sine_of(source), phi_star = std::atan2(sine, source.x);
  // phi falls from infinity at the edge to 0 at the far end.
  double low = 0, high = zone.reach;
  for (int step = 0; step < 200 && high - low > 1e-16; ++step) {
    const double middle = (low + high) / 2;
    (zone.azimuth(middle) > phi_star ? low : high) = middle;
  }
  return tetrad_direction(zone.ray((low + high) / 2), optics.inward, across(source, sine));
}

}  // namespace domefall
