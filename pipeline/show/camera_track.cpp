#include <algorithm>
#include <cmath>

#include "pipeline/show/attitude.h"
#include "pipeline/show/carried_camera.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

Camera camera_at(const Segment& s, double t) {
  Camera camera = s.camera;
  camera.roll = value_at(s, Channel::kRoll, t, camera.roll);
  camera.elevation = value_at(s, Channel::kElevation, t, camera.elevation);
  camera.dome_tilt = value_at(s, Channel::kDomeTilt, t, camera.dome_tilt);
  return camera;
}

// The way from one keyframe to the next is followed in this many steps.  Rotations that differ by
// whole turns lead to the same attitude, and each step takes the one that continues the step
// before.
constexpr int kTurnSteps = 64;

// Says whether an attitude stays the same against the tetrad, whatever the observer does.
bool is_fixed(const AttitudeKey& key) { return std::holds_alternative<EulerAngles>(key.attitude); }

// A Turn is the camera's rotation from one attitude to the next, while the targets of both may
// move.
class Turn {
 public:
  Turn(const Show& show, int segment, const Projection& projection, const AttitudeKey& from,
       const AttitudeKey& to)
      : show_(show), segment_(segment), projection_(projection), from_(from), to_(to) {}

  M33d axes_at(double t, const ObserverState& observer) const {
    // x is the part of the way that has passed, and `steps` the number of steps that begin before
    // t.
    const double x = (t - from_.at_s) / (to_.at_s - from_.at_s);
    const int steps = std::clamp(static_cast<int>(std::ceil(x * kTurnSteps)), 1, kTurnSteps);
    // The rotation at the last step before t tells which one to continue.
    const V3d before = is_constant()       ? V3d(0, 0, 0)
                       : to_.turns.empty() ? followed(steps).back()
                                           : to_.turns[static_cast<std::size_t>(steps) - 1];
    const V3d turn = turn_at(t, observer, before);
    return turned_by(axes(from_, t, observer), turn * eased(to_.ease, x));
  }

  // Says whether both attitudes are fixed, so that the shortest way from the one to the other is
  // the same at all times.
  bool is_constant() const { return is_fixed(from_) && is_fixed(to_); }

  // Returns the rotations at the first `steps` steps of the way.  Each continues the one before it,
  // and the first is the shortest.
  std::vector<V3d> followed(int steps) const {
    std::vector<V3d> turns;
    turns.reserve(static_cast<std::size_t>(steps));
    V3d turn(0, 0, 0);
    for (int k = 0; k < steps; ++k) {
      const double at = std::lerp(from_.at_s, to_.at_s, static_cast<double>(k) / kTurnSteps);
      const int segment = segment_then(at);
      turn = turn_at(at, observer_at(show_, segment, part_at(show_, segment, at)), turn);
      turns.push_back(turn);
    }
    return turns;
  }

 private:
  // Returns the segment seen at t, since the turn may begin before its own segment and end after
  // it.  During a dissolve two segments are seen, and the turn's own one counts.
  int segment_then(double t) const {
    const auto s = static_cast<std::size_t>(segment_);
    const double begin = begin_of(show_, segment_);
    const bool own = t >= begin && t <= begin + show_.timeline[s].duration_s;
    return own ? segment_ : segment_at(show_, t);
  }
  M33d axes(const AttitudeKey& key, double t, const ObserverState& observer) const {
    Camera camera = camera_at(segment_of(show_, segment_), t);
    camera.attitude = key.attitude;
    return camera_axes(camera, projection_, observer, show_.effects);
  }
  V3d turn_at(double t, const ObserverState& observer, const V3d& before) const {
    return turn_between(axes(from_, t, observer), axes(to_, t, observer), before);
  }

  const Show& show_;
  int segment_;
  const Projection& projection_;
  const AttitudeKey &from_, &to_;
};

// Returns the axes of a camera that follows its target.
M33d aimed_axes(const Show& show, int segment, double t, const Projection& projection,
                const ObserverState& observer) {
  const Segment& s = segment_of(show, segment);
  Camera camera = camera_at(s, t);
  const auto& keys = s.attitudes;
  if (keys.empty()) return camera_axes(camera, projection, observer, show.effects);
  // `next` is the first keyframe behind t.  Before the first one its attitude holds, and behind the
  // last one that of the last.
  const auto next = std::upper_bound(
      keys.begin(), keys.end(), t, [](double at, const AttitudeKey& key) { return at < key.at_s; });
  if (next != keys.begin() && next != keys.end() && next->ease != Ease::kHold)
    return Turn(show, segment, projection, *(next - 1), *next).axes_at(t, observer);
  camera.attitude = (next == keys.begin() ? next : next - 1)->attitude;
  return camera_axes(camera, projection, observer, show.effects);
}

}  // namespace

// What is keyframed turns a camera that keeps its direction as it would have where that was taken.
M33d camera_axes_at(const Show& show, int segment, double t, const Projection& projection,
                    const ObserverState& observer) {
  if (segment_of(show, segment).camera.frame == CameraFrame::kHole)
    return aimed_axes(show, segment, t, projection, observer);
  const CarriedTurn carried = carried_turn(show, segment, t, observer);
  return carried.turn *
         aimed_axes(show, segment, t, projection, observer_at(show, carried.since, 0));
}

void follow_turns(Show& show) {
  const std::vector<double> times = segment_times(show);
  for (std::size_t s = 0; s < show.timeline.size(); ++s) {
    std::vector<AttitudeKey>& keys = show.timeline[s].attitudes;
    const double begin = times[s], end = begin + show.timeline[s].duration_s;
    for (std::size_t k = 1; k < keys.size(); ++k)
      // A segment has the show's keyframes too, but shows only the turns that overlap it.
      if (const Turn turn(show, static_cast<int>(s), show.projection, keys[k - 1], keys[k]);
          keys[k].ease != Ease::kHold && keys[k].at_s > begin && keys[k - 1].at_s < end &&
          !turn.is_constant())
        keys[k].turns = turn.followed(kTurnSteps);
  }
}

}  // namespace domefall
