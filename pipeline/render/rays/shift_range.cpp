#include "pipeline/render/rays/shift_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/light/silhouette.h"

namespace domefall {
namespace {

// This is the plane of R and c, in which the angle of a direction is measured from R.
struct Plane {
  double gamma, radial, across, s;

  // Returns the frequency ratio in a direction of the plane.  gamma + c.m cancels behind a fast
  // observer.  Since gamma - |c| = 1/(gamma + |c|), it is also the sum of positive terms
  //     gamma + |c| cos x = 1/(gamma + |c|) + 2 |c| cos^2(x/2),
  // where x is the angle between c and m.
  double ratio(double angle) const {
    const double length = std::hypot(radial, across);
    const double half = std::cos((angle - std::atan2(across, radial)) / 2);
    return (1 / (gamma + length) + 2 * length * half * half) / std::abs(1 + s * std::cos(angle));
  }
};

}  // namespace

std::optional<ShiftRange> frequency_range(const ObserverState& o, SkyRegion sky, bool straight) {
  if (!seen_skies(o)[sky]) return std::nullopt;
  const bool own = sky == own_sky(o.tetrad);
  if (straight || is_flat(o)) {
    // The extreme Doppler factors are gamma -+ |c|, each of which is the inverse of the other.
    const double speed = static_celerity(o).length(), gamma = std::hypot(1.0, speed);
    const double hole = o.spacetime.gravitational_ratio(o.r);
    return ShiftRange{hole / (gamma + speed), hole * (gamma + speed)};
  }
  const double s = o.spacetime.free_fall_speed(o.r);
  const auto c = rain_celerity(o.spacetime, o.r, o.tetrad, o.celerity);
  const Plane plane{gamma_of(c), c.x, std::hypot(c.y, c.z), s};
  // The own sky of the tetrad extends from R to the silhouette, and the other one from its edge to
  // -R.
  const double edge = std::numbers::pi - (own ? silhouette_edge(o.r) : region_three_edge(o.r));
  std::vector<double> angles{edge, -edge, own ? 0 : std::numbers::pi};
  // The equation of the header for the extremes is solved as length cos(a - axis) = -s c_t.
  const double b = s * plane.gamma - plane.radial, length = std::hypot(plane.across, b);
  const double cosine = -s * plane.across / length;
  if (length > 0 && std::abs(cosine) <= 1) {
    const double axis = std::atan2(b, plane.across), apart = std::acos(cosine);
    for (const double angle : {axis + apart, axis - apart}) {
      const double wrapped = std::remainder(angle, 2 * std::numbers::pi);
      if (own ? std::abs(wrapped) < edge : std::abs(wrapped) > edge) angles.push_back(wrapped);
    }
  }
  ShiftRange range{HUGE_VAL, 0};
  for (const double angle : angles) {
    const double ratio = plane.ratio(angle);
    range = {std::min(range.least, ratio), std::max(range.largest, ratio)};
  }
  return range;
}

}  // namespace domefall
