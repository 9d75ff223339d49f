#include "pipeline/show/frame_state.h"

#include <algorithm>
#include <cmath>

#include "pipeline/show/attitude.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

const Segment& segment_of(const Show& show, int k) {
  return show.timeline[static_cast<std::size_t>(k)];
}

const std::optional<Curve>& curve_of(const Segment& s, Channel channel) {
  return s.curves[static_cast<std::size_t>(channel)];
}

double value_of(const Segment& s, Channel channel, double t, double constant) {
  const auto& curve = curve_of(s, channel);
  return curve ? value_at(*curve, t) : constant;
}

// Everything of the camera but its attitude.
Camera camera_at(const Segment& s, double t) {
  Camera camera = s.camera;
  camera.roll = value_of(s, Channel::kRoll, t, camera.roll);
  camera.elevation = value_of(s, Channel::kElevation, t, camera.elevation);
  camera.dome_tilt = value_of(s, Channel::kDomeTilt, t, camera.dome_tilt);
  return camera;
}

// Steps in which the way from one keyframe to the next is followed, to know which of the turns that
// lead to the same attitude goes on from the one before.
constexpr int kTurnSteps = 64;

class Turn {
 public:
  Turn(const Show& show, int segment, const Projection& projection, const AttitudeKey& from,
       const AttitudeKey& to)
      : show_(show), segment_(segment), projection_(projection), from_(from), to_(to) {}

  M33d axes_at(double t, const ObserverState& observer) const {
    const double span = to_.at_s - from_.at_s, x = (t - from_.at_s) / span;
    V3d turn(0, 0, 0);
    for (int k = 0; k < kTurnSteps && k < x * kTurnSteps; ++k) {
      const double at = from_.at_s + span * k / kTurnSteps;
      const int segment = segment_at(show_, at);
      turn = turn_at(at, observer_at(show_, segment, part_at(show_, segment, at)), turn);
    }
    turn = turn_at(t, observer, turn);
    const double done = to_.ease == Ease::kSmooth ? smooth_step(x) : x;
    return turned_by(axes(from_, t, observer), turn * done);
  }

 private:
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

Picture picture_at(const Show& show, const Segment& s, double t) {
  Picture picture;
  picture.ev = value_of(s, Channel::kEv, t, show.exposure.ev);
  const auto set = [&](Picture::Sky& sky, const RegionSky& own, Channel gain, Channel star_gain,
                       Channel magnitude) {
    sky.background_gain = value_of(s, gain, t, own.background_gain);
    sky.star_gain = value_of(s, star_gain, t, own.star_gain);
    sky.max_magnitude = value_of(s, magnitude, t, own.stars.value_or(StarField{}).max_magnitude);
    const auto& limit = curve_of(s, magnitude);
    sky.soft_limit = limit && limit->keys.size() > 1;
  };
  set(picture.sky_one, show.sky_one, Channel::kGainOne, Channel::kStarGainOne,
      Channel::kMagnitudeOne);
  set(picture.sky_three, show.sky_three, Channel::kGainThree, Channel::kStarGainThree,
      Channel::kMagnitudeThree);
  picture.sky_four.background_gain =
      value_of(s, Channel::kGainFour, t, show.sky_four.background_gain);
  return picture;
}

FrameState state_in(const Show& show, int segment, int frame) {
  const Segment& s = segment_of(show, segment);
  FrameState state;
  state.frame = frame;
  state.show_time_s = frame / show.frames_per_second;
  state.segment = segment;
  const double t = state.show_time_s;
  state.projection = show.projection;
  if (auto* flat = std::get_if<Stereographic>(&state.projection))
    flat->fov = value_of(s, Channel::kFov, t, flat->fov);
  state.picture = picture_at(show, s, t);
  state.observer = observer_at(show, segment, part_at(show, segment, t));
  state.observer.tetrad_from_camera =
      camera_axes_at(show, segment, t, state.projection, state.observer);
  return state;
}

}  // namespace

M33d camera_axes_at(const Show& show, int segment, double t, const Projection& projection,
                    const ObserverState& observer) {
  const Segment& s = segment_of(show, segment);
  Camera camera = camera_at(s, t);
  const auto& keys = s.attitudes;
  if (keys.empty()) return camera_axes(camera, projection, observer, show.effects);
  const auto next = std::upper_bound(
      keys.begin(), keys.end(), t, [](double at, const AttitudeKey& key) { return at < key.at_s; });
  if (next != keys.begin() && next != keys.end() && next->ease != Ease::kHold)
    return Turn(show, segment, projection, *(next - 1), *next).axes_at(t, observer);
  camera.attitude = (next == keys.begin() ? next : next - 1)->attitude;
  return camera_axes(camera, projection, observer, show.effects);
}

FrameState frame_state(const Show& show, int frame) {
  const double t = frame / show.frames_per_second;
  const int segment = segment_at(show, t);
  FrameState state = state_in(show, segment, frame);
  const double dissolve = segment_of(show, segment).dissolve_s;
  const double faded = t - segment_times(show)[static_cast<std::size_t>(segment)];
  if (segment == 0 || !(faded < dissolve)) return state;
  state.vanishing = std::make_shared<const FrameState>(state_in(show, segment - 1, frame));
  state.vanishing_part = 1 - smooth_step(faded / dissolve);
  return state;
}

}  // namespace domefall
