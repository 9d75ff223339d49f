#include "pipeline/light/charted_ray.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/emission_time.h"
#include "pipeline/light/ray_methods.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

constexpr double kKruskalAbove = 0.5, kKruskalBelow = 2.5;

// These are the largest terms that the series beyond the goals leave unexpanded: (b/r)^2 far out,
// r/2 and r^3/2b^2 near the singularity.
constexpr double kFarShare = 1e-3, kNearShare = 1e-5;

bool in_kruskal_zone(double r) { return r >= kKruskalAbove && r <= kKruskalBelow; }

// One of U, V that does not vanish where the ray meets the horizon is set to 1, and the other by U
// V.  Their rates are k^U = U (E + k^r)/4A and k^V = -V (E - k^r)/4A, with A = -2 U V exp(-r/2)/r
// divided out.  Of E + k^r and E - k^r the one without cancellation is used.  The other follows
// from 2 F k^U k^V = (L/r)^2, since light is null.
ChartedRay in_kruskal(const PhotonAtObserver& k, double t, double phi) {
  const double r = k.r, growth = std::exp(r / 2), l = k.angular_momentum;
  const double product = -(r / 2 - 1) * growth;
  ChartedRay ray{Chart::kKruskal, k.region, {}, 0};
  if (k.energy * k.radial <= 0) {
    const double u = sign_of_u(k.region), ingoing = k.energy - k.radial;
    ray.y = {u,
             product / u,
             phi,
             -l * l * u / (4 * r * r * ingoing),
             -r * growth / 8 * ingoing / u,
             l / (r * r)};
  } else {
    const double v = sign_of_v(k.region), outgoing = k.energy + k.radial;
    ray.y = {product / v, v, phi, r * growth / 8 * outgoing / v, l * l * v / (4 * r * r * outgoing),
             l / (r * r)};
  }
  // On the horizon there is no t to keep.
  if (product != 0) ray.shift = t - kruskal_time({ray.y[0], ray.y[1], 0, 0});
  return ray;
}

ChartedRay in_schwarzschild(const PhotonAtObserver& k) {
  const double a = 1 - 2 / k.r;
  return {Chart::kSchwarzschild,
          k.region,
          {0, k.r, 0, -k.energy / a, -k.radial, k.angular_momentum / (k.r * k.r)},
          0};
}

// Returns the photon of a point of a ray in Schwarzschild's coordinates.
PhotonAtObserver photon_of(const ChartedRay& ray) {
  const double r = ray.y[1], a = 1 - 2 / r;
  return {ray.region, r, -a * ray.y[3], r * r * ray.y[kAzimuthRate], -ray.y[4]};
}

void to_schwarzschild(ChartedRay& ray, double r) {
  const auto [u, v, phi, u1, v1, phi1] = ray.y;
  const double common = -4 * std::exp(-r / 2) / r, a = 1 - 2 / r;
  ray.chart = Chart::kSchwarzschild;
  ray.region = kruskal_region(u, v);
  ray.y = {kruskal_time({u, v, ray.shift, 0}), r,   phi, common * (u1 * v - u * v1) / a,
           common * (u1 * v + u * v1),         phi1};
  ray.shift = 0;
}

// The chart changes to Kruskal's when r enters its zone, and from it when r leaves.
bool leaves_schwarzschild(const RayState& y) {
  return y[1] > 2 ? y[1] < kKruskalBelow && y[4] < 0 : y[1] > kKruskalAbove && y[4] > 0;
}

bool leaves_kruskal(const RayState& y, double r) {
  const double product_rate = y[3] * y[1] + y[0] * y[4];  // has the opposite sign of r'
  return (r > kKruskalBelow && product_rate < 0) || (r < kKruskalAbove && product_rate > 0);
}

// phi = int dw / sqrt(1/b^2 - w^2 + 2 w^3) from 0 to w is expanded in b w.
double azimuth_to_infinity(double b, double w) {
  const double x = b * w, x2 = x * x;
  return x * (1 + x2 / 6 - x2 * w / 4 + 3 * x2 * x2 / 40);
}

// phi = int dr / sqrt(2 r - r^2 + r^4/b^2) from 0 to r is expanded in y = r/2 - r^3/2b^2.
double azimuth_to_singularity(double inverse_b, double r) {
  const double x = r * inverse_b;
  return std::sqrt(2 * r) * (1 + r / 12 - r * x * x / 28 + 3 * r * r / 160);
}

}  // namespace

double radius_of(const ChartedRay& ray) {
  return ray.chart == Chart::kSchwarzschild ? ray.y[1] : 2 + radius_less_two(ray.y[0] * ray.y[1]);
}

NullTimes null_times_of(const ChartedRay& ray) {
  if (ray.chart == Chart::kKruskal)
    return {ray.shift + 4 * std::log(std::abs(ray.y[0])),
            ray.shift - 4 * std::log(std::abs(ray.y[1]))};
  const double t = ray.y[0], star = Schwarzschild::tortoise(ray.y[1]);
  return {t + star, t - star};
}

ChartedRay charted_ray(const PhotonAtObserver& photon) {
  return in_kruskal_zone(photon.r) ? in_kruskal(photon, 0, 0) : in_schwarzschild(photon);
}

RayGoals goals_of(const PhotonAtObserver& photon) {
  constexpr double kFarAtLeast = 1e4, kDecade = 10;
  const double l = photon.angular_momentum, e = std::abs(photon.energy);
  RayGoals goals{std::max(kFarAtLeast, kDecade * photon.r),
                 std::min(2 * kNearShare, photon.r / kDecade)};
  if (l > 0) {
    // Without energy no ray reaches a sky, and with little only one of little momentum.
    if (e > 0) goals.far = std::max(goals.far, l / (kFarShare * e));
    if (e > 0) goals.near = std::min(goals.near, std::cbrt(2 * kNearShare * (l / e) * (l / e)));
  }
  return goals;
}

bool change_chart(ChartedRay& ray) {
  if (ray.chart == Chart::kSchwarzschild) {
    if (!leaves_schwarzschild(ray.y)) return false;
    ray = in_kruskal(photon_of(ray), ray.y[0], ray.y[kAzimuth]);
    return true;
  }
  const double r = radius_of(ray);
  if (!leaves_kruskal(ray.y, r)) return false;
  to_schwarzschild(ray, r);
  return true;
}

void restore_null_condition(ChartedRay& ray) {
  const double r = ray.y[1];
  if (ray.chart != Chart::kSchwarzschild || r > 2) return;
  const double a = 1 - 2 / r, energy = a * ray.y[3], tangential = r * ray.y[kAzimuthRate];
  const double speed = std::sqrt(energy * energy - a * tangential * tangential);
  ray.y[4] = std::copysign(speed, ray.y[4]);
}

std::optional<SkyRegion> origin_of(const ChartedRay& ray, const RayGoals& goals) {
  if (ray.chart == Chart::kKruskal) return std::nullopt;
  const double r = ray.y[1], rate = ray.y[4];
  if (ray.region == Region::kIV && r <= goals.near && rate < 0) return SkyRegion::kIV;
  if (r < goals.far || rate <= 0) return std::nullopt;
  return ray.region == Region::kI ? SkyRegion::kI : SkyRegion::kIII;
}

double azimuth_beyond(const ChartedRay& ray, SkyRegion origin) {
  const PhotonAtObserver k = photon_of(ray);
  const double l = k.angular_momentum, e = std::abs(k.energy);
  if (l == 0) return 0;
  return origin == SkyRegion::kIV ? azimuth_to_singularity(e / l, k.r)
                                  : azimuth_to_infinity(l / e, 1 / k.r);
}

}  // namespace domefall
