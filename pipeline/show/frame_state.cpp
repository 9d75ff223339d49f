#include "pipeline/show/frame_state.h"

#include <algorithm>
#include <cmath>

#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

// Returns the settings of a segment at t, where curves go before the values of the show.
FrameSettings settings_at(const Show& show, const Segment& s, double t) {
  FrameSettings settings;
  settings.ev = value_at(s, Channel::kEv, t, show.exposure.ev);
  for (const SkyRegion region : kEverySky) {
    const RegionSky& own = show.sky[region];
    FrameSettings::Sky& sky = settings.sky[region];
    sky.background_gain = value_at(s, gain_channel(region), t, own.background_gain);
    sky.star_gain = value_at(s, star_gain_channel(region), t, own.star_gain);
    const Channel magnitude = max_magnitude_channel(region);
    sky.max_magnitude = value_at(s, magnitude, t, own.stars.value_or(StarField{}).max_magnitude);
    const std::optional<Curve>& limit = s.curves[magnitude];
    // A curve of a single key does not change.
    sky.soft_limit = limit && limit->keys.size() > 1;
  }
  if (show.disc) {
    const double luminance = show.disc->luminance;
    settings.disc_gain = value_at(s, Channel::kDiscLuminance, t, luminance) / luminance;
    settings.disc_opacity = value_at(s, Channel::kDiscOpacity, t, show.disc->opacity);
  }
  settings.title_gain = value_at(s, Channel::kTitleGain, t, 1);
  settings.title_opacity = value_at(s, Channel::kTitleOpacity, t, 1);
  if (std::ranges::none_of(s.magnitudes, [](const auto& curve) { return curve.has_value(); }))
    return settings;
  for (std::size_t k = 0; k < show.bodies.size(); ++k)
    settings.magnitudes.push_back(s.magnitudes[k] ? value_at(*s.magnitudes[k], t)
                                                  : show.bodies[k].magnitude);
  return settings;
}

Cdl cdl_at(const Show& show, const Segment& s, double t) {
  const Cdl& of_show = show.grade.cdl;
  Cdl cdl;
  for (std::size_t k = 0; k < 3; ++k) {
    cdl.slope[k] = value_at(s, colour_channel(Channel::kSlopeR, k), t, of_show.slope[k]);
    cdl.offset[k] = value_at(s, colour_channel(Channel::kOffsetR, k), t, of_show.offset[k]);
    cdl.power[k] = value_at(s, colour_channel(Channel::kPowerR, k), t, of_show.power[k]);
  }
  cdl.saturation = value_at(s, Channel::kSaturation, t, of_show.saturation);
  return cdl;
}

// Returns a number during a dissolve, while the part `vanishing` of `other` is left.
double mixed(double number, double other, double vanishing) {
  return number + (other - number) * vanishing;
}

Cdl mixed(const Cdl& cdl, const Cdl& other, double vanishing) {
  const auto mix = [vanishing](double a, double b) { return mixed(a, b, vanishing); };
  Cdl between;
  for (std::size_t k = 0; k < 3; ++k) {
    between.slope[k] = mix(cdl.slope[k], other.slope[k]);
    between.offset[k] = mix(cdl.offset[k], other.offset[k]);
    between.power[k] = mix(cdl.power[k], other.power[k]);
  }
  between.saturation = mix(cdl.saturation, other.saturation);
  return between;
}

// Returns the part of the light that the fades of the segment and of the show leave together.
double fade_at(const Show& show, int segment, double t) {
  const Segment& s = segment_of(show, segment);
  const double begin = begin_of(show, segment), end = begin + s.duration_s;
  return light_left(s.fades, begin, end, t) * light_left(show.fades, 0, end_of(show), t);
}

// With the axes S of the tetrad on the sky, a direction d of the sky has the components S^T d along
// them.  These change by (S'^T S) S^T d, where S'^T S is antisymmetric and thus stands for a
// rotation vector.  The difference is taken over a 64th of a frame, so that it holds up to some 60
// radians a frame.  No film shows more.  The result is rounded, since its last bits differ between
// processors.
V3d sky_turn_at(const Show& show, int segment, double instant) {
  constexpr double kHalf = 1.0 / 128, kSteps = 1e9;
  const auto axes = [&](double frames) {
    const double t = instant + frames / show.frames_per_second;
    return observer_at(show, segment, part_at(show, segment, t)).sky_from_tetrad;
  };
  const double begin = begin_of(show, segment), end = begin + segment_of(show, segment).duration_s;
  const double before = std::max(-kHalf, (begin - instant) * show.frames_per_second);
  const double after = std::min(kHalf, (end - instant) * show.frames_per_second);
  if (!(after > before)) return V3d(0, 0, 0);
  const M33d first = axes(before), last = axes(after);
  // (S'^T S)[i][j] is the scalar product of the change of axis i and of axis j, taken midway.
  const auto change = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += (last[k][i] - first[k][i]) * (last[k][j] + first[k][j]) / 2;
    return sum / (after - before);
  };
  // Adding 0 turns -0 into 0.
  const auto rounded = [](double v) { return std::round(v * kSteps) / kSteps + 0.0; };
  return {rounded(change(2, 1)), rounded(change(0, 2)), rounded(change(1, 0))};
}

// Returns the state of a frame in one segment, without a dissolve.  The image may have another size
// than the show's.
FrameState state_in(const Show& show, int segment, int frame, double t, const Projection& image) {
  const Segment& s = segment_of(show, segment);
  FrameState state;
  state.frame = frame;
  state.show_time_s = t;
  state.segment = segment;
  state.projection = image;
  if (const auto fov = field_of_view(show.projection))
    state.projection = with_field_of_view(image, value_at(s, Channel::kFov, t, *fov));
  state.settings = settings_at(show, s, t);
  state.cdl = cdl_at(show, s, t);
  state.fade = fade_at(show, segment, t);
  state.observer = observer_at(show, segment, part_at(show, segment, t));
  state.sky_turn = sky_turn_at(show, segment, t);
  state.observer.tetrad_from_camera =
      camera_axes_at(show, segment, t, state.projection, state.observer);
  state.camera_from_audience =
      audience_axes(state.projection, value_at(s, Channel::kDomeTilt, t, s.camera.dome_tilt));
  return state;
}

// Returns the state of a frame of that segment, together with the segment that vanishes during a
// dissolve.
FrameState state_at(const Show& show, int segment, int frame, double t, const Projection& image) {
  FrameState state = state_in(show, segment, frame, t, image);
  const double dissolve = segment_of(show, segment).dissolve_s;
  const double faded = t - begin_of(show, segment);
  if (segment == 0 || !(faded < dissolve)) return state;
  // The segment before still runs, since the dissolve lies within its last seconds.
  state.vanishing =
      std::make_shared<const FrameState>(state_in(show, segment - 1, frame, t, image));
  state.vanishing_part = 1 - smooth_step(faded / dissolve);
  state.cdl = mixed(state.cdl, state.vanishing->cdl, state.vanishing_part);
  // Titles are drawn once, over the mixture of both views.
  const FrameSettings& other = state.vanishing->settings;
  for (double FrameSettings::*number : {&FrameSettings::title_gain, &FrameSettings::title_opacity})
    state.settings.*number = mixed(state.settings.*number, other.*number, state.vanishing_part);
  return state;
}

}  // namespace

std::vector<Body> bodies_at(const Show& show, const FrameSettings& settings) {
  std::vector<Body> bodies = show.bodies;
  for (std::size_t k = 0; k < settings.magnitudes.size(); ++k)
    bodies[k].magnitude = settings.magnitudes[k];
  return bodies;
}

FrameState frame_state(const Show& show, int frame) {
  const double t = frame / show.frames_per_second;
  return state_at(show, segment_at(show, t), frame, t, show.projection);
}

ObserverState observer_after(const Show& show, const FrameState& state, double frames,
                             CameraMotion camera) {
  const double begin = begin_of(show, state.segment),
               end = begin + segment_of(show, state.segment).duration_s;
  const double t = std::clamp(state.show_time_s + frames / show.frames_per_second, begin, end);
  ObserverState observer = observer_at(show, state.segment, part_at(show, state.segment, t));
  if (camera == CameraMotion::kMoves) {
    observer.tetrad_from_camera =
        camera_axes_at(show, state.segment, t, state.projection, observer);
    return observer;
  }
  const ObserverState& now = state.observer;
  observer.tetrad_from_camera = now.tetrad_from_camera;
  // Null times of two tetrads or universes cannot be compared.
  if (observer.tetrad != now.tetrad || observer.universe != now.universe) return observer;
  ObserverState staying = now;
  staying.sky_from_tetrad = observer.sky_from_tetrad;
  staying.null_time = observer.null_time - (observer.l - now.l);
  return staying;
}

SegmentSpan segment_span(const Show& show, const FrameState& state) {
  const double begin = begin_of(show, state.segment),
               end = begin + segment_of(show, state.segment).duration_s;
  return {std::min(0.0, (begin - state.show_time_s) * show.frames_per_second),
          std::max(0.0, (end - state.show_time_s) * show.frames_per_second)};
}

std::vector<FrameState> exposure_states(const Show& show, const FrameState& state, int count) {
  const double t = state.frame / show.frames_per_second;
  const double half = show.exposure.shutter / show.frames_per_second / 2;
  const int segment = segment_at(show, t);
  const double begin = begin_of(show, segment);
  // The shutter opens as long before the frame's instant as it closes after it, within the segment.
  const double opened = std::max(t - half, begin),
               closed = std::min(t + half, begin + segment_of(show, segment).duration_s);
  std::vector<FrameState> states;
  states.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    // The middles of equal parts make the mean over the states the midpoint rule of integration.
    states.push_back(state_at(show, segment, state.frame,
                              opened + (closed - opened) * (k + 0.5) / count, state.projection));
    states.back().draft = state.draft;
  }
  return states;
}

}  // namespace domefall
