#include "pipeline/show/keyframes.h"

#include "pipeline/show/show_time.h"

namespace domefall {
namespace {

// Reads one keyframe, whose time may be a marker's name.
Keyframe read_keyframe(const Item& item, const KeyframeSpan& span,
                       const std::vector<Marker>& markers, ShowCamera& camera, Lookup& lookup) {
  const Section s(item, {"at_s", "name", "ease", "camera", "exposure", "grade", "sky"});
  Keyframe keyframe;
  const Item* time = s.require("at_s", " (seconds)");
  const auto at =
      time ? read_time(*time, Range{"seconds"}.within(0, span.latest), markers, span.start)
           : std::nullopt;
  // A keyframe whose time is in error counts as the first instant, so that the rest of it is
  // checked.
  keyframe.at_s = span.start + at.value_or(0);
  keyframe.ease =
      s.word<Ease>("ease",
                   {{"smooth", Ease::kSmooth}, {"linear", Ease::kLinear}, {"hold", Ease::kHold}})
          .value_or(Ease::kSmooth);
  // A keyframe has numbers alone, since a background cannot turn into another one by degrees.
  keyframe.values = read_values(s, false);
  if (const Item* own = s.find("camera")) {
    const CameraKeys keys = read_camera(*own, camera, lookup);
    keyframe.attitude = keys.attitude;
    // read_values() leaves the camera's channels empty, so that nothing is replaced.
    lay_over(keyframe.values, keys.values);
  }
  // A name stands for what the camera looks at, so that a keyframe without an attitude enters none.
  if (const Item* name = s.find("name"))
    if (const auto text = read_text(*name); text && keyframe.attitude)
      camera.named.keyframes[*text] = *keyframe.attitude;
  return keyframe;
}

}  // namespace

std::vector<Keyframe> read_keyframes(const Item& item, const KeyframeSpan& span,
                                     const std::vector<Marker>& markers, ShowCamera& camera,
                                     Lookup& lookup) {
  std::vector<Keyframe> keyframes;
  const auto items = read_list(item);
  if (!items) return keyframes;
  for (const Item& entry : *items) {
    keyframes.push_back(read_keyframe(entry, span, markers, camera, lookup));
    const std::size_t n = keyframes.size();
    // Two keyframes at one time are refused as well, since a curve through both would jump.  A time
    // that is missing has been reported already.
    if (n > 1 && !(keyframes[n - 1].at_s > keyframes[n - 2].at_s) && peek(entry, "at_s"))
      peek(entry, "at_s")
          ->fail("must be later than that of the keyframe before it, " +
                 short_number(keyframes[n - 2].at_s - span.start) + " (seconds)");
  }
  return keyframes;
}

std::optional<Curve> curve_through(const std::vector<Keyframe>& keyframes, Channel channel,
                                   double start, double value_there) {
  Curve curve;
  for (const Keyframe& keyframe : keyframes) {
    const std::optional<double>& value = keyframe.values[channel];
    if (!value) continue;
    // Without a key at its start the curve would have the first keyframe's value before it already.
    if (curve.keys.empty() && keyframe.at_s > start) curve.keys.push_back({start, value_there});
    curve.keys.push_back({keyframe.at_s, *value, keyframe.ease});
  }
  if (curve.keys.empty()) return std::nullopt;
  return curve;
}

// An attitude at the start stands in as a value does in curve_through().
std::vector<AttitudeKey> attitudes_through(const std::vector<Keyframe>& keyframes, double start,
                                           const Attitude& attitude_there) {
  std::vector<AttitudeKey> keys;
  for (const Keyframe& keyframe : keyframes) {
    if (!keyframe.attitude) continue;
    if (keys.empty() && keyframe.at_s > start) keys.push_back({start, attitude_there});
    keys.push_back({keyframe.at_s, *keyframe.attitude, keyframe.ease});
  }
  return keys;
}

}  // namespace domefall
