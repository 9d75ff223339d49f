#include "pipeline/show/file/sections.h"
#include "pipeline/show/file/show_time.h"

namespace domefall {
namespace {

void read_colours(const Section& cdl, std::string_view key, Channel red, ChannelValues& values) {
  const Item* item = cdl.find(key);
  if (!item) return;
  const Range range = cdl.range(key);
  const auto numbers = item->node.IsSequence() ? read_numbers(*item, 3, range) : std::nullopt;
  const auto number = item->node.IsSequence() ? std::nullopt : read_number(*item, range);
  for (std::size_t k = 0; k < 3 && (numbers || number); ++k)
    values[colour_channel(red, k)] = numbers ? (*numbers)[k] : *number;
}

Keyframe read_keyframe(const Item& item, const KeyframeSpan& span, const Show& show,
                       ShowCamera& camera, Lookup& lookup) {
  const Section s(item, {"keyframes"});
  Keyframe keyframe;
  const Item* time = s.require("at_s", " (seconds)");
  const auto at =
      time ? read_time(*time, s.range("at_s").at_most(span.latest), show.markers, span.start)
           : std::nullopt;
  keyframe.at_s = span.start + at.value_or(0);
  using enum Ease;
  keyframe.ease = s.word("ease", {kSmooth, kLinear, kHold, kEased, kEasedIn, kEasedOut});
  // A keyframe has numbers alone, since a background cannot turn into another one by degrees.
  keyframe.values = read_values(s, show);
  keyframe.magnitudes = read_magnitudes(s, show);
  if (const Item* own = s.find("camera")) {
    const CameraKeys keys = read_camera(*own, camera, lookup);
    if (!keys.track.empty())
      own->fail("has a file, which is for the camera of a show or a segment");
    if (keys.frame) own->fail("has a frame, which is of the camera of a show or a segment");
    keyframe.attitude = keys.attitude;
    lay_over(keyframe.values, keys.values);
  }
  // A name stands for what the camera looks at, so that a keyframe without an attitude enters none.
  if (const Item* name = s.find("name"))
    if (const auto text = read_text(*name); text && keyframe.attitude)
      camera.keyframes[*text] = *keyframe.attitude;
  return keyframe;
}

}  // namespace

void read_cdl(const Section& grade, ChannelValues& values) {
  const Section cdl(grade.find("cdl"), {"cdl"});
  read_colours(cdl, "slope", Channel::kSlopeR, values);
  read_colours(cdl, "offset", Channel::kOffsetR, values);
  read_colours(cdl, "power", Channel::kPowerR, values);
  values[Channel::kSaturation] = cdl.given("saturation");
}

ChannelValues read_values(const Section& section, const Show& show,
                          const BackgroundReader& read_background) {
  ChannelValues values;
  values[Channel::kEv] = Section(section.find("exposure"), {"exposure"}).given("ev");
  read_cdl(Section(section.find("grade"), {"grade.cdl"}), values);
  const Item* disc = section.find("disc");
  if (disc && !show.disc) disc->fail("needs a disc: give the show one");
  const Section light(disc, {"disc.light"});
  values[Channel::kDiscLuminance] = light.given("luminance_cd_m2");
  values[Channel::kDiscOpacity] = light.given("opacity");
  const Section titles(section.find("title_light"), {"title_light"});
  values[Channel::kTitleGain] = titles.given("gain");
  values[Channel::kTitleOpacity] = titles.given("opacity");
  const Section sky(section.find("sky"), {"sky"});
  const std::string_view background = read_background ? "sky.background" : "sky.gain";
  for (const SkyRegion region : kEverySky) {
    const bool singularity = region == SkyRegion::kIV;
    const std::string_view more = !singularity      ? "sky.stars"
                                  : read_background ? "sky.rings"
                                                    : "sky.gain";
    const Item* given = sky.find(kSkyKeys[region]);
    if (given && region == SkyRegion::kNext && !show.spacetime.leads_on()) {
      fail_next_sky(*given, show.spacetime);
      continue;
    }
    const Section own(given, {"sky.gain", more, background});
    values[gain_channel(region)] = own.given("gain");
    if (read_background) read_background(region, own);
    if (singularity) continue;
    const Section stars(own.find("stars"), {"sky.light"});
    values[star_gain_channel(region)] = stars.given("gain");
    values[max_magnitude_channel(region)] = stars.given("max_magnitude");
  }
  return values;
}

Magnitudes read_magnitudes(const Section& section, const Show& show) {
  Magnitudes magnitudes(show.bodies.size());
  const Item* list = section.find("bodies");
  if (!list) return magnitudes;
  if (!list->node.IsMap()) {
    list->fail("must be a map of names, e.g. {beacon: {magnitude: 4}}, got " + kind_of(*list));
    return magnitudes;
  }
  std::map<std::string, std::size_t, std::less<>> known;
  for (std::size_t k = 0; k < show.bodies.size(); ++k) known[show.bodies[k].name] = k;
  for (const auto& [name, item] : entries_of(*list)) {
    const auto found = known.find(name);
    if (found == known.end()) {
      std::vector<std::string_view> names;
      for (const Body& body : show.bodies) names.push_back(body.name);
      item.fail("is no body of the show" + did_you_mean(name, names));
      continue;
    }
    const Section s(item, {"body.light"});
    const auto magnitude = s.given("magnitude");
    if (!magnitude) continue;
    Body body = show.bodies[found->second];
    body.magnitude = *magnitude;
    check_body(body, show.spacetime, *s.find("magnitude"), nullptr);
    magnitudes[found->second] = *magnitude;
  }
  return magnitudes;
}

std::vector<Keyframe> read_keyframes(const Item& item, const KeyframeSpan& span, const Show& show,
                                     ShowCamera& camera, Lookup& lookup) {
  std::vector<Keyframe> keyframes;
  const auto items = read_list(item);
  if (!items) return keyframes;
  for (const Item& entry : *items) {
    keyframes.push_back(read_keyframe(entry, span, show, camera, lookup));
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

std::optional<Curve> curve_through(const std::vector<Keyframe>& keyframes,
                                   const NumberOf& number_of, double start, double value_there) {
  Curve curve;
  for (const Keyframe& keyframe : keyframes) {
    const std::optional<double> value = number_of(keyframe);
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
