#include "pipeline/light/hole_optics.h"

#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"

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

Critical home_critical(bool outgoing) { return outgoing ? Critical::kSecond : Critical::kFirst; }

// alpha counts from -R in rain, from +R in the outgoing frame.
TetradDirection tetrad_direction(const NullRay& ray, const V3d& e) {
  const double sine = 2 * ray.sin_half * ray.cos_half;
  const double cosine = (ray.cos_half - ray.sin_half) * (ray.cos_half + ray.sin_half);
  return {V3d(ray.outgoing ? cosine : -cosine, 0, 0) + e * sine};
}

}  // namespace

HoleOptics make_hole_optics(const Radius& at, Tetrad tetrad, WantedSkies wanted) {
  HoleOptics optics;
  optics.at = at;
  optics.tetrad = tetrad;
  if (std::isinf(at.r)) return optics;
  const bool outgoing = is_outgoing(tetrad), outside = at.above_horizon > 0;
  if (outside || !outgoing) optics.home_edge.emplace(at, home_critical(outgoing));
  if (at.above_horizon < 0 && !outgoing) optics.far_edge.emplace(at, Critical::kSecond);
  add_tables(optics, wanted);
  return optics;
}

void add_tables(HoleOptics& optics, WantedSkies wanted) {
  const bool outgoing = is_outgoing(optics.tetrad);
  const auto [home, far] = optics.skies();
  if (wanted.sky[home] && !optics.home_sky && optics.home_edge)
    optics.home_sky.emplace(optics.at, home_critical(outgoing), outgoing, optics.table_bits);
  if (wanted.sky[far] && !optics.far_sky && optics.far_edge)
    optics.far_sky.emplace(optics.at, Critical::kSecond, false, optics.table_bits);
  if (wanted.sky[SkyRegion::kIV] && !optics.white_hole && !std::isinf(optics.at.r))
    optics.white_hole.emplace(optics.at, outgoing, optics.table_bits);
  if (wanted.emission_times && !optics.emission_times && optics.white_hole)
    optics.emission_times.emplace(*optics.white_hole, optics.table_bits);
}

bool lacks_tables(const HoleOptics& optics, const WantedSkies& wanted) {
  const auto [home, far] = optics.skies();
  return (wanted.sky[home] && !optics.home_sky) || (wanted.sky[far] && !optics.far_sky) ||
         (wanted.sky[SkyRegion::kIV] && !optics.white_hole) ||
         (wanted.emission_times && !optics.emission_times);
}

int table_count(const HoleOptics& optics) {
  return int{optics.home_sky.has_value()} + int{optics.far_sky.has_value()} +
         int{optics.white_hole.has_value()} + int{optics.emission_times.has_value()};
}

std::size_t node_count(const HoleOptics& optics) {
  return (optics.home_sky ? optics.home_sky->node_count() : 0) +
         (optics.far_sky ? optics.far_sky->node_count() : 0) +
         (optics.white_hole ? optics.white_hole->node_count() : 0) +
         (optics.emission_times ? optics.emission_times->node_count() : 0);
}

SkyImage image_of(const SkyTable* table, const V3d& source, int order, double axis_blur) {
  if (table == nullptr) return {{source}, 1, 1};
  const double sine = sine_of(source);
  const Order o = order_of(std::atan2(sine, source.x), order);
  const double x = table->distance(o.phi);
  const NullRay ray = table->ray_at_distance(x);
  SkyImage image;
  image.direction = tetrad_direction(ray, across(source, sine) * o.side);
  image.frequency_ratio = 1 / one_plus_z(ray);
  // At the far end, where sin(alpha) and sin(phi) vanish together, their ratio is 1/slope.
  const double slope = table->slope(x);
  const bool far_end = order == 0 && o.phi < 1e-6;
  image.amplification =
      far_end ? 1 / (slope * slope)
              : 2 * ray.sin_half * ray.cos_half / (std::hypot(sine, axis_blur) * slope);
  return image;
}

WhiteHoleImages images_of(const WhiteHoleTable& table, const V3d& source, int order,
                          double axis_blur) {
  const double sine = sine_of(source);
  const Order o = order_of(std::atan2(sine, source.x), order);
  const WhiteHoleTable::Branches branches = table.rays_of(o.phi);
  // Near a fold phi = phi_0 + c (alpha - alpha_0)^2/2, a source of radius rho is no narrower than
  // sqrt(2 rho/c), and its slope is no less than sqrt(2 rho c).
  const double least_slope =
      table.turn() ? std::sqrt(2 * axis_blur * std::abs(table.turn()->curvature)) : 0;
  WhiteHoleImages images;
  images.count = branches.count;
  for (int k = 0; k < images.count; ++k) {
    const NullRay& ray = branches.ray[static_cast<std::size_t>(k)];
    SkyImage& image = images.image[static_cast<std::size_t>(k)];
    const double sin_alpha = 2 * ray.sin_half * ray.cos_half;
    image.direction = tetrad_direction(ray, across(source, sine) * o.side);
    image.frequency_ratio = 1;
    const double slope = table.slope(table.place_of(ray));
    image.amplification =
        sin_alpha > 0 ? sin_alpha / (std::hypot(sine, axis_blur) * std::hypot(slope, least_slope))
                      : 0;
  }
  return images;
}

TetradDirection primary_image(double r, Tetrad tetrad, const V3d& source) {
  if (std::isinf(r)) return {source};
  const bool outgoing = is_outgoing(tetrad);
  const Critical edge = home_critical(outgoing);
  const double sine = sine_of(source), phi_star = std::atan2(sine, source.x);
  const double tangent = tan_half_critical(r, edge), sign = outgoing ? -1 : 1;
  const auto ray_at_offset = [&](double offset) {
    return ray_off_edge(r, edge, sign * offset, {outgoing, false});
  };
  // phi falls from infinity at the edge to 0 at the far end.
  double low = 0, high = 2 * (outgoing ? std::atan(tangent) : std::atan2(1.0, tangent));
  for (int step = 0; step < 200 && high - low > 1e-16; ++step) {
    const double middle = (low + high) / 2;
    (exact_azimuth(ray_at_offset(middle)) > phi_star ? low : high) = middle;
  }
  return tetrad_direction(ray_at_offset((low + high) / 2), across(source, sine));
}

}  // namespace domefall
