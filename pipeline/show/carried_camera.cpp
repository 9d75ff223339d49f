#include "pipeline/show/carried_camera.h"

#include <numbers>
#include <stdexcept>
#include <type_traits>

#include "pipeline/show/observer_track.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

template <class Kind, class... Kinds>
constexpr bool kIsOneOf = (std::is_same_v<Kind, Kinds> || ...);

enum class Carrier { kHeld, kFalling, kFlown, kNone };

Carrier carrier_of(const Trajectory& trajectory) {
  return std::visit(
      []<class Kind>(const Kind&) {
        if (kIsOneOf<Kind, StaticObserver, CircularOrbit, ChargedCircle, KerrCircling>)
          return Carrier::kHeld;
        if (kIsOneOf<Kind, RadialInfall, Geodesic, ChargedOrbit, KerrOrbit>)
          return Carrier::kFalling;
        if (kIsOneOf<Kind, AcceleratedPath, Spiral, BrakedFlight, KerrFlight>)
          return Carrier::kFlown;
        return Carrier::kNone;
      },
      trajectory);
}

Gyroscope::Hole hole_of(const Spacetime& spacetime) {
  if (const auto* hole = std::get_if<SpinningHole>(&spacetime.kind()))
    return {static_cast<double>(hole->kerr.spin), static_cast<double>(hole->kerr.charge)};
  const auto* charged = std::get_if<ChargedHole>(&spacetime.kind());
  return {0, charged ? charged->charge : 0, !charged};
}

// Returns a point with an angle from the axis, which orbits about holes without spin do not have.
OrbitPoint carrying_point(const Segment& s, bool spins, const ProperTime& tau) {
  OrbitPoint point = placed(point_at(s.trajectory, tau), s.placement);
  if (!spins) point.theta = std::numbers::pi / 2;
  return point;
}

M33d gyroscope_turn(const Show& show, int segment, const ProperTime& tau) {
  const auto k = static_cast<std::size_t>(segment);
  const auto held = show.joints.empty() ? nullptr : show.joints[k].gyroscope;
  return (held ? held : gyroscope_of(show.spacetime, show.timeline[k]))->turn(tau);
}

// Says whether a camera goes on from the segment before as it was.
bool goes_on(const Show& show, int segment, const ObserverState& before,
             const ObserverState& after) {
  const Segment &s = segment_of(show, segment), &last = segment_of(show, segment - 1);
  if (s.camera.frame != last.camera.frame || s.aims) return false;
  constexpr double kSame = 1e-6;
  const V3d moves =
      apply(before.sky_from_tetrad, before.celerity) - apply(after.sky_from_tetrad, after.celerity);
  const V3d place = column(before.sky_from_tetrad, 0) - column(after.sky_from_tetrad, 0);
  return before.tetrad == after.tetrad && before.universe == after.universe &&
         !(std::abs(before.r - after.r) > kSame * before.r) && place.length() < kSame &&
         moves.length() < kSame * gamma_of(before.celerity);
}

}  // namespace

std::string why_no_gyroscope(const Spacetime& spacetime, const Segment& segment) {
  if (spacetime.is_flat() || spacetime.is<Wormhole>())
    return "gyroscopes are followed near holes only; in this space the far stars tell the same";
  if (carrier_of(segment.trajectory) == Carrier::kNone)
    return "a motion of which one instant is held carries no gyroscope";
  constexpr int kSamples = 64;
  const auto span = double(segment.timing.tau_end - segment.timing.tau_begin);
  for (int k = 0; k <= kSamples; ++k) {
    const ProperTime tau =
        k < kSamples ? segment.timing.tau_begin + span * k / kSamples : segment.timing.tau_end;
    if (placed(point_at(segment.trajectory, tau), segment.placement).tetrad != Tetrad::kRain)
      return "it comes from region III or IV, where gyroscopes are not followed";
  }
  try {
    gyroscope_of(spacetime, segment);
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return {};
}

std::shared_ptr<const Gyroscope> gyroscope_of(const Spacetime& spacetime, const Segment& segment) {
  const Gyroscope::Hole hole = hole_of(spacetime);
  const bool spins = spacetime.is<SpinningHole>();
  const Carrier carrier = carrier_of(segment.trajectory);
  const Timing& timing = segment.timing;
  // The way outlives the segment, of which it holds a copy.
  const auto way = [segment, spins](const ProperTime& tau) {
    return carrying_point(segment, spins, tau);
  };
  if (carrier == Carrier::kHeld)
    return std::make_shared<const Gyroscope>(Gyroscope::held(
        hole, way(timing.tau_begin), way(1.0).azimuth - way(0.0).azimuth, timing.tau_begin));
  return std::make_shared<const Gyroscope>(
      Gyroscope::along(hole, way, carrier == Carrier::kFalling, timing.tau_begin, timing.tau_end));
}

CarriedTurn carried_turn(const Show& show, int segment, double t, const ObserverState& observer) {
  const bool by_stars = segment_of(show, segment).camera.frame == CameraFrame::kStars;
  CarriedTurn carried{segment, M33d()};
  if (!by_stars)
    carried.turn = gyroscope_turn(
        show, segment, proper_time_at(segment_of(show, segment), part_at(show, segment, t)));
  ObserverState start = observer_at(show, segment, 0);
  for (; carried.since > 0; --carried.since) {
    const ObserverState end = observer_at(show, carried.since - 1, 1);
    if (!goes_on(show, carried.since, end, start)) break;
    if (!by_stars)
      carried.turn = carried.turn * (start.sky_from_tetrad.transposed() * end.sky_from_tetrad) *
                     gyroscope_turn(show, carried.since - 1,
                                    segment_of(show, carried.since - 1).timing.tau_end);
    start = observer_at(show, carried.since - 1, 0);
  }
  if (by_stars) carried.turn = observer.sky_from_tetrad.transposed() * start.sky_from_tetrad;
  return carried;
}

}  // namespace domefall
