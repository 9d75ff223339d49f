#include "pipeline/render/rays/view_circle.h"

#include <cmath>
#include <numbers>

namespace domefall {

// Directions n with n.u = cos(alpha) are those whose light ray (1, -n) is orthogonal to the vector
// (cos(alpha), -u) of space-time.  So the boost changes the circle as it changes that vector.  The
// square of the vector, -sin^2(alpha), stays the same and gives the sine of the new circle.
ViewCircle view_circle(const HalfAngle& alpha, const ObserverState& observer, const V3d& celerity) {
  const V3d inward(is_outgoing(observer.tetrad) ? 1 : -1, 0, 0);
  const double sine = 2 * alpha.sine * alpha.cosine;
  const double cosine = (alpha.cosine - alpha.sine) * (alpha.cosine + alpha.sine);
  const double gamma = std::sqrt(1 + celerity.length2()), along = celerity.dot(inward);
  const double time = gamma * cosine + along;
  const V3d space = inward + celerity * (along / (gamma + 1) + cosine);
  const double length = space.length();
  return {apply_transposed(observer.tetrad_from_camera, space / length), time / length,
          sine / length};
}

std::vector<ViewCircle> silhouette_circles(const ObserverState& observer, const V3d& celerity) {
  const HoleOptics optics =
      make_hole_optics(observer.r, observer.tetrad, {{false, false, false}, false});
  std::vector<ViewCircle> circles;
  for (const SkyRegion sky : optics.skies())
    if (const SkyEdge* edge = optics.edge_of(sky))
      circles.push_back(view_circle(edge->half, observer, celerity));
  return circles;
}

std::vector<ViewCircle> einstein_circles(const ObserverState& observer, const V3d& celerity) {
  const HoleOptics optics =
      make_hole_optics(observer.r, observer.tetrad, {{true, true, false}, false});
  std::vector<ViewCircle> circles;
  for (const SkyRegion sky : optics.skies()) {
    const SkyTable* table = optics.table_of(sky);
    if (table == nullptr) continue;
    const NullRay ray = table->ray_at_distance(table->distance(std::numbers::pi));
    circles.push_back(view_circle({ray.sin_half, ray.cos_half}, observer, celerity));
  }
  return circles;
}

}  // namespace domefall
