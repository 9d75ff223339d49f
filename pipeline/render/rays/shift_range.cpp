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
  double gamma, radial, across;
  StaticTime time;

  // Returns the frequency ratio in a direction of the plane.  gamma + c.m cancels behind a fast
  // observer.  Since gamma - |c| = 1/(gamma + |c|), it is also the sum of positive terms
  //     gamma + |c| cos x = 1/(gamma + |c|) + 2 |c| cos^2(x/2),
  // where x is the angle between c and m.
  double ratio(double angle) const {
    const double length = std::hypot(radial, across);
    const double half = std::cos((angle - std::atan2(across, radial)) / 2);
    return (1 / (gamma + length) + 2 * length * half * half) /
           std::abs(time.along_t + time.along_r * std::cos(angle));
  }
};

// Returns the angle from -R, in rain, at which the sky ends that is the tetrad's own, or the other.
double edge_from_hole(const Spacetime& spacetime, double r, bool own) {
  if (const auto* hole = std::get_if<ChargedHole>(&spacetime.kind())) {
    const auto edges = hole->critical_tangents(hole->at(r));
    return 2 * std::atan(std::abs(static_cast<double>(own ? edges.first : edges.second)));
  }
  // All light has the energy 1 in a wormhole, so that any part of the view stands for the whole.
  if (spacetime.is<Wormhole>()) return own ? 0 : std::numbers::pi;
  return own ? silhouette_edge(r) : region_three_edge(r);
}

}  // namespace

std::optional<ShiftRange> frequency_range(const ObserverState& o, SkyRegion sky, bool straight) {
  if (!seen_skies(o)[sky]) return std::nullopt;
  const bool own = sky == own_sky(o);
  if (straight || is_flat(o)) {
    // The extreme Doppler factors are gamma -+ |c|, each of which is the inverse of the other.
    const double speed = static_celerity(o).length(), gamma = std::hypot(1.0, speed);
    const double hole = o.spacetime.gravitational_ratio(o.r);
    return ShiftRange{hole / (gamma + speed), hole * (gamma + speed)};
  }
  const StaticTime time = o.spacetime.static_time(o.r);
  const auto c = rain_celerity(o.spacetime, o.r, o.tetrad, o.celerity);
  const Plane plane{gamma_of(c), c.x, std::hypot(c.y, c.z), time};
  // The own sky of the tetrad extends from R to the silhouette, and the other one from its edge to
  // -R.
  const double edge = std::numbers::pi - edge_from_hole(o.spacetime, o.r, own);
  std::vector<double> angles{edge, -edge, own ? 0 : std::numbers::pi};
  // The equation of the header for the extremes is solved as length cos(a - axis) = -s c_t.
  const double b = time.along_r * plane.gamma - time.along_t * plane.radial;
  const double across = time.along_t * plane.across, length = std::hypot(across, b);
  const double cosine = -time.along_r * plane.across / length;
  if (length > 0 && std::abs(cosine) <= 1) {
    const double axis = std::atan2(b, across), apart = std::acos(cosine);
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
