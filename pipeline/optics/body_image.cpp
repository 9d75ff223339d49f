#include "pipeline/optics/body_image.h"

#include <cmath>
#include <numbers>

#include "pipeline/optics/emission_time.h"

namespace domefall {
namespace {

// One guess of when the light left the body, and what it leads to.
struct RetardedImage {
  BodyPoint body;
  PlaceImage place;
  V3d across;  // the direction to which the ray sweeps
  double psi;
  double t;  // at which light of that order would have left the place
};

std::optional<RetardedImage> image_at(const PlaceView& view, double null_time,
                                      const BodyMotion& motion, int order, double radius,
                                      double t) {
  using std::numbers::pi;
  const BodyPoint body = motion(t);
  const V3d& n = body.direction;
  const double sine = std::hypot(n.y, n.z), angle = std::atan2(sine, n.x);
  const bool same_side = order % 2 == 0;
  const double psi = same_side ? angle + order * pi : (order + 1) * pi - angle;
  const V3d towards = sine > 0 ? V3d(0, n.y, n.z) / sine : V3d(0, 1, 0);
  const auto place = image_of_place(view, body.r, psi, radius / body.r);
  if (!place) return std::nullopt;
  const double star = tortoise(body.r);
  return RetardedImage{body, *place, towards * (same_side ? 1.0 : -1.0), psi,
                       null_time + place->null_time + (view.outgoing ? star : -star)};
}

// nu = E u^t - k_r u^r - L.L'/r^2 of light that is one in the tetrad.  Its angular momentum is that
// of light which comes back along the ray: -L about R x across.
double emitted(const RetardedImage& image) {
  const BodyPoint& body = image.body;
  const RayInvariants k = invariants(image.place.ray);
  const double lapse = 1 - 2 / body.r, r2 = body.r * body.r;
  const double radial = -k.angular_momentum * image.place.slope / r2;
  const V3d axis = V3d(1, 0, 0).cross(image.across);
  const double around = -k.angular_momentum * axis.dot(body.angular_momentum) / r2;
  return (k.energy * body.energy - radial * body.radial) / lapse - around;
}

V3d seen_direction(const RetardedImage& image) {
  const NullRay& ray = image.place.ray;
  const double sine = 2 * ray.sin_half * ray.cos_half;
  const double cosine = (ray.cos_half - ray.sin_half) * (ray.cos_half + ray.sin_half);
  return V3d(ray.outgoing ? cosine : -cosine, 0, 0) + image.across * sine;
}

}  // namespace

std::optional<BodyImage> image_of_body(const PlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius) {
  constexpr int kSteps = 60;
  constexpr double kEnough = 1e-10;
  double t = null_time;
  auto image = image_at(view, null_time, motion, order, radius, t);
  // A body is slower than light, so that what is left of the error shrinks by itself; a secant
  // makes it quick.
  double before = 0, error_before = 0;
  for (int step = 0; image && step < kSteps; ++step) {
    const double error = image->t - t;
    if (std::abs(error) <= kEnough * image->body.r) {
      const double ratio = 1 / emitted(*image);
      return BodyImage{seen_direction(*image),
                       ratio,
                       image->body.r,
                       t,
                       image->place.solid_angle_per_area,
                       image->psi};
    }
    const double fall = step > 0 ? (error_before - error) / (t - before) : 1;
    before = t;
    error_before = error;
    t += fall > 0.1 && fall < 10 ? error / fall : error;
    image = image_at(view, null_time, motion, order, radius, t);
  }
  return std::nullopt;
}

}  // namespace domefall
