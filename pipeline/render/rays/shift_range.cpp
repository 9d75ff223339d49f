#include "pipeline/render/rays/shift_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/light/hole_optics.h"
#include "pipeline/light/kerr_lens.h"
#include "pipeline/light/lens_store.h"

namespace domefall {
namespace {

// This is the plane of R and c, in which the angle of a direction is measured from R.
struct Plane {
  double gamma, radial, across;
  ViewEnergy energy;
  double inward;  // of HoleOptics

  // 1 + z goes by half of alpha, which counts from -R where inward is 1.
  double from_hole(double angle) const { return inward > 0 ? std::numbers::pi - angle : angle; }

  // Returns the frequency ratio in a direction of the plane.  gamma + c.m cancels behind a fast
  // observer.  Since gamma - |c| = 1/(gamma + |c|), it is also the sum of positive terms
  //     gamma + |c| cos x = 1/(gamma + |c|) + 2 |c| cos^2(x/2),
  // where x is the angle between c and m.
  double ratio(double angle) const {
    const double length = std::hypot(radial, across), alpha = from_hole(std::abs(angle));
    const double half = std::cos((angle - std::atan2(across, radial)) / 2);
    const double s = std::sin(alpha / 2), c = std::cos(alpha / 2);
    return (1 / (gamma + length) + 2 * length * half * half) /
           energy.one_plus_z(energy.sine2 * s * s + energy.cosine2 * c * c);
  }

  // Returns the angles at which the ratio is extreme in the plane, by the equation of the header,
  // length cos(a - axis) = -s c_t.
  std::vector<double> extremes() const {
    const double along_t = (energy.sine2 + energy.cosine2) / 2;
    const double along_r = inward * (energy.sine2 - energy.cosine2) / 2;
    const double b = along_r * gamma - along_t * radial, a = along_t * across;
    const double length = std::hypot(a, b), cosine = -along_r * across / length;
    if (!(length > 0 && std::abs(cosine) <= 1)) return {};
    const double axis = std::atan2(b, a), apart = std::acos(cosine);
    return {std::remainder(axis + apart, 2 * std::numbers::pi),
            std::remainder(axis - apart, 2 * std::numbers::pi)};
  }
};

// Looks at directions evenly spread over the sky, and at its edge.
std::optional<ShiftRange> range_near_spin(const SpinningHole& hole, const ObserverState& o,
                                          SkyRegion sky) {
  constexpr int kRows = 64, kAround = 128;
  const KerrPlace at = kerr_place(hole, o);
  const KerrEdge edge = sky == SkyRegion::kI ? KerrEdge::kSilhouette : KerrEdge::kRegionThree;
  const double end = sky == SkyRegion::kI ? std::numbers::pi : 0, gamma = gamma_of(o.celerity);
  const KerrEnergy energy(at);
  ShiftRange range{HUGE_VAL, 0};
  for (int j = 0; j < kAround; ++j) {
    const double eta = 2 * std::numbers::pi * j / kAround;
    const double rim = kerr_edge_delta(at, eta, edge);
    for (int i = 0; i <= kRows; ++i) {
      const double delta = rim + (end - rim) * i / kRows;
      const double ratio =
          (gamma + o.celerity.dot(kerr_view(delta, eta))) / std::abs(energy(delta, eta));
      range = {std::min(range.least, ratio), std::max(range.largest, ratio)};
    }
  }
  return range;
}

}  // namespace

std::optional<ShiftRange> frequency_range(const ObserverState& o, SkyRegion sky, bool straight) {
  if (!seen_skies(o)[sky]) return std::nullopt;
  if (straight || is_flat(o)) {
    // The extreme Doppler factors are gamma -+ |c|, each of which is the inverse of the other.
    const double speed = static_celerity(o).length(), gamma = std::hypot(1.0, speed);
    const double hole = o.spacetime.gravitational_ratio(o.r);
    return ShiftRange{hole / (gamma + speed), hole * (gamma + speed)};
  }
  if (const auto* hole = std::get_if<SpinningHole>(&o.spacetime.kind()))
    return range_near_spin(*hole, o, sky);
  const HoleOptics optics = optics_of(o);
  const Celerity<ReferenceTetrad>& c = o.celerity;
  const Plane plane{gamma_of(c), c.x, std::hypot(c.y, c.z), optics.energy, optics.inward};
  ShiftRange range{HUGE_VAL, 0};
  const auto add = [&](double angle) {
    const double ratio = plane.ratio(angle);
    range = {std::min(range.least, ratio), std::max(range.largest, ratio)};
  };
  // The sky extends from the edge of each of its zones to the axis.
  for (const SkyPart& part : optics.parts) {
    if (part.sky != sky) continue;
    const SkyEdge& edge = part.zone.edge;
    const double rim = edge.half.angle(), end = edge.sign > 0 ? std::numbers::pi : 0;
    for (const double angle : {rim, -rim, end}) add(plane.from_hole(angle));
    for (const double angle : plane.extremes())
      if (edge.sign * (plane.from_hole(std::abs(angle)) - rim) > 0) add(angle);
  }
  return range;
}

}  // namespace domefall
