#include <fmt/format.h>

#include "pipeline/base/errors.h"
#include "pipeline/base/frame_rate.h"
#include "pipeline/show/attitude.h"
#include "pipeline/show/camera_world.h"
#include "pipeline/show/file/camera_file.h"
#include "pipeline/show/file/sections.h"

namespace domefall {
namespace {

// frame_size.cpp has the same bounds for --size.
constexpr int kFewestPixels = 16, kMostPixels = 16384;
constexpr Range kPixels = Range{"pixels"}.within(kFewestPixels, kMostPixels);
constexpr std::array<std::string_view, 4> kSizeNames{"1k", "2k", "4k", "8k"};

// Reads 1k, 2k, 4k, 8k or a number of pixels, at most `most`.  `why` tells why it is one number.
int read_one_size(const Item& size, int fallback, int most, std::string_view why) {
  if (!size.node.IsScalar()) {
    size.fail(fmt::format("must be 1k, 2k, 4k, 8k or a number of pixels ({}), got {}", why,
                          kind_of(size)));
    return fallback;
  }
  const Range range = kPixels.at_most(most);
  for (std::size_t k = 0; k < kSizeNames.size(); ++k)
    if (size.node.Scalar() == kSizeNames[k]) {
      // The names double from 1024 pixels on.
      const int pixels = 1024 << k;
      if (pixels > most)
        size.fail(fmt::format("must be at most {} (pixels; {}), got {}", most, why, kSizeNames[k]));
      return pixels;
    }
  // For a word, and for '3k', the message names the sizes.  For a number it names the bounds.  A
  // sign and a point are let through, so that -5 and 0.5 are told the bounds.
  if (size.node.Scalar().find_first_not_of("+-.0123456789") == std::string::npos)
    return read_whole_number(size, range).value_or(fallback);
  size.fail(fmt::format("must be 1k, 2k, 4k, 8k or a number of pixels from {} to {}, got '{}'{}",
                        kFewestPixels, most, shown(size.node.Scalar()),
                        did_you_mean(size.node.Scalar(), kSizeNames)));
  return fallback;
}

// Reads [width, height].  A side in error stays as it is.
Projection read_sides(const Item& size, const Projection& usual) {
  const std::vector<Item> items = *read_list(size);
  const int width = read_whole_number(items[0], kPixels).value_or(columns(usual)),
            height = read_whole_number(items[1], kPixels).value_or(rows(usual));
  if (traits_of(usual).is_dome && height > most_rows(width, pixel_aspect(usual)))
    size.fail(fmt::format(
        "must be at most as high as wide (the circle of a fisheye touches both sides{}), got [{}, "
        "{}]",
        pixel_aspect(usual) == 1
            ? ""
            : fmt::format(", which are {} pixels", most_rows(width, pixel_aspect(usual))),
        width, height));
  return with_sides(usual, width, height);
}

Projection read_size(const Item& size, const Projection& usual) {
  const ProjectionTraits& traits = traits_of(usual);
  if (has_free_shape(usual) && size.node.IsSequence() && size.node.size() == 2)
    return read_sides(size, usual);
  if (traits.one_number.empty()) {
    size.fail("must be [width, height] in pixels (this projection is flat), got " + kind_of(size));
    return usual;
  }
  const double aspect = pixel_aspect(usual);
  const int pixels = read_one_size(
      size, columns(usual) / traits.in_width,
      most_rows(kMostPixels, std::min(1.0, 1 / aspect)) / traits.in_width, traits.one_number);
  if (traits.even && pixels % 2 != 0)
    size.fail(fmt::format("must be even (a whole sphere is half as high as wide), got {}", pixels));
  const int width = traits.in_width * pixels;
  return with_sides(usual, width, most_rows(width, aspect));
}

// Reads a number, or a ratio such as 16:11.
std::optional<double> read_ratio(const Item& item, const Range& range) {
  std::string text = item.node.IsScalar() ? item.node.Scalar() : std::string();
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return read_number(item, range);
  constexpr int kMost = 10000;
  text[colon] = '/';
  // Its text is that of a fraction, and so are its bounds.
  const FrameRate ratio = parse_frame_rate(text);
  if (ratio.seconds > 0 && std::max(ratio.frames, ratio.seconds) <= kMost)
    return in_range(item, per_second(ratio), range);
  return item.fail(fmt::format(
      "must be a number, or a ratio of two whole numbers up to {} such as 16:11, got {}", kMost,
      kind_of(item)));
}

// Returns the names of the projections of which something holds, as they stand in a message.
template <class Holds>
std::string projections_that(const Holds& holds) {
  std::vector<std::string_view> names;
  for (const Projection& usual : kUsualProjections)
    if (holds(usual)) names.push_back(projection_name(usual));
  const std::string_view last = names.back();
  names.pop_back();
  return names.empty() ? std::string(last) : fmt::format("{} and {}", fmt::join(names, ", "), last);
}

// Reads where the rows that a fisheye lower than wide lacks are cut off: this part of them at the
// back of the dome, and the rest at the front.
Projection read_cut(const Section& camera, const Projection& projection) {
  const Item* cut = camera.find("cut");
  const bool can_cut = cut_back(projection).has_value();
  if (cut && !can_cut)
    cut->fail(fmt::format("goes with the {} projection only", projections_that(cut_back)));
  if (cut && can_cut &&
      rows(projection) == most_rows(columns(projection), pixel_aspect(projection)))
    cut->fail("is for a size of [width, height] that is lower than wide; this one is a square");
  return can_cut ? with_cut_back(projection, camera.word("cut", {1.0, 0.0, 0.5})) : projection;
}

// Reads `pixel_aspect`, which the section `output` has.  The size of a fisheye depends on it.
Projection read_pixels(const Section& show, const Projection& projection) {
  const Item* output = show.find("output");
  const auto given = output ? peek(*output, "pixel_aspect") : std::nullopt;
  if (!given) return projection;
  const auto row = std::ranges::find(keys_of("output"), "pixel_aspect", &Key::name);
  const double aspect = read_ratio(*given, row->range()).value_or(1);
  if (aspect != 1 && !may_have_pixel_aspect(projection))
    given->fail(fmt::format("goes with the projections {}; the pixels of a {} are square",
                            projections_that(may_have_pixel_aspect), projection_name(projection)));
  // Without a size a fisheye shows all of its circle.
  const Projection made = with_pixel_aspect(projection, aspect);
  return traits_of(made).is_dome ? with_sides(made, columns(made), most_rows(columns(made), aspect))
                                 : made;
}

// Reads the projection with the show's `size`.  A variable opening angle has its default.
Projection read_projection(const Section& show, const Section& camera) {
  // The projection comes before the size, since it decides which form that has.
  Projection projection = read_pixels(show, camera.word("projection", kUsualProjections));
  if (const Item* size = show.find("size")) projection = read_size(*size, projection);
  projection = read_cut(camera, projection);
  return with_field_of_view(projection, radians(traits_of(projection).usual_deg));
}

// Returns the bounds of an opening angle in degrees, or nothing if the projection has only one
// angle.  The radius of a stereographic image goes as tan(fov/4), which is infinite at 360 degrees.
// That of a fisheye goes as the angle, so that a fisheye can show the whole sphere.  A flat image
// without distortion stretches its edges beyond use long before 180 degrees.
std::optional<Range> fov_range(const Projection& projection) {
  const ProjectionTraits& traits = traits_of(projection);
  if (traits.widest_deg == 0) return std::nullopt;
  const Range range = Range{"degrees"}.above(0);
  return traits.below_widest ? range.below(traits.widest_deg) : range.at_most(traits.widest_deg);
}

// Reads a target, which is a word, what another keyframe looks at, a body or a place on the sky.
// The words come before names of places, so that no star of such a name is meant.
std::optional<Attitude> read_look_at(const Item& item, const ShowCamera& show, Lookup& lookup) {
  static const Words<Attitude, 3> kWords{
      {{"hole", LookAtHole{}}, {"motion", LookAlongMotion{}}, {"outward", LookOutward{}}}};
  if (auto attitude = meaning(item, kWords)) return attitude;
  if (peek(item, "keyframe") || peek(item, "body")) {
    const Section s(item, {"look_at"});
    const Item* name = s.one_of({"keyframe", "body"});
    if (name == s.find("keyframe")) {
      const auto* attitude =
          find_named(*name, show.keyframes,
                     "names no keyframe before this one that has a name and a direction");
      return attitude ? std::optional(*attitude) : std::nullopt;
    }
    const auto* body = find_named(*name, show.bodies, "names no body of the show");
    return body ? std::optional<Attitude>(LookAtBody{*body}) : std::nullopt;
  }
  if (const auto place = read_sky_place(item, lookup, names_of(kWords))) return LookAtSky{*place};
  return std::nullopt;
}

std::optional<Attitude> read_attitude(const Section& camera, const ShowCamera& show,
                                      Lookup& lookup) {
  for (const std::string_view key : {"look_at", "roll_deg", "elevation_deg"})
    camera.one_of({"euler_deg", key});
  if (const Item* euler = camera.find("euler_deg")) {
    const auto angle = read_numbers(*euler, 3, camera.range("euler_deg"));
    if (!angle) return std::nullopt;
    return EulerAngles{radians((*angle)[0]), radians((*angle)[1]), radians((*angle)[2])};
  }
  const Item* look_at = camera.find("look_at");
  return look_at ? read_look_at(*look_at, show, lookup) : std::nullopt;
}

// Reads the attitudes of a camera that another program has animated, for a dome that leans by
// `tilt`.
std::vector<AttitudeKey> read_track(const Item& item, double tilt, const ShowCamera& show,
                                    const Lookup& lookup) {
  std::vector<AttitudeKey> track;
  const auto name = read_text(item);
  const auto file = name ? lookup.file(item, *name) : std::nullopt;
  if (!file) return track;
  try {
    for (const CameraSample& sample : read_camera_file(*file, show.frames_per_second)) {
      const M33d axes = base_from_camera(sample.world_from_camera, show.projection);
      track.push_back({sample.at_s, euler_angles_of(untilted(axes, tilt)), Ease::kLinear});
    }
  } catch (const InputError& error) {
    item.fail(error.what());
  }
  return track;
}

// Reads the keys that every camera may have.  Which of them make sense depends on the projection of
// the show.
CameraKeys read_camera_keys(const Section& camera, const ShowCamera& show, Lookup& lookup) {
  const auto angle = [&camera](std::string_view key, const Range& range) {
    const auto degrees = camera.given(key, range);
    return degrees ? std::optional(radians(*degrees)) : std::nullopt;
  };
  CameraKeys keys;
  keys.attitude = read_attitude(camera, show, lookup);
  keys.frame = camera.given_word(
      "frame", {CameraFrame::kHole, CameraFrame::kGyroscope, CameraFrame::kStars});
  // A roll may be ten turns either way, since keyframes change it as a number and may spin the
  // image.
  keys.values[Channel::kRoll] = angle("roll_deg", camera.range("roll_deg"));
  keys.values[Channel::kElevation] = angle("elevation_deg", camera.range("elevation_deg"));
  keys.values[Channel::kDomeTilt] = angle("dome_tilt_deg", camera.range("dome_tilt_deg"));
  const Projection& projection = show.projection;
  const bool zenith = has_zenith(projection);
  for (const std::string_view key : {"look_at", "euler_deg", "roll_deg", "elevation_deg"})
    camera.one_of({"file", key});
  const double tilt =
      keys.values[Channel::kDomeTilt].value_or(show.keys.values[Channel::kDomeTilt].value_or(0));
  if (const Item* file = camera.find("file"))
    keys.track = read_track(*file, zenith ? tilt : 0, show, lookup);
  // A flat image has its target in the middle, where neither a rim nor a tilt moves it.
  for (const std::string_view key : {"elevation_deg", "dome_tilt_deg"})
    if (const Item* item = camera.find(key); item && !zenith)
      item->fail("is for domes; this projection is flat");
  if (const auto range = fov_range(projection))
    keys.values[Channel::kFov] = angle("fov_deg", *range);
  else if (const Item* fov = camera.find("fov_deg"))
    fov->fail(fmt::format(
        "goes with the projections {}; {} {} shows {} degrees", projections_that(field_of_view),
        std::string_view("aeiou").find(projection_name(projection).front()) < 5 ? "an" : "a",
        projection_name(projection), traits_of(projection).shown_deg));
  return keys;
}

bool is_euler(const std::optional<Attitude>& attitude) {
  return attitude && std::holds_alternative<EulerAngles>(*attitude);
}

// Reads a camera other than the show's own, which alone gives the projection.
CameraKeys read_further_camera(const Item& item, const ShowCamera& show, Lookup& lookup) {
  const Section camera(item, {"camera"});
  for (const std::string_view key : {"projection", "cut"})
    if (const Item* fixed = camera.find(key))
      fixed->fail("holds for the whole show; it belongs in the show's own camera section");
  CameraKeys own = read_camera_keys(camera, show, lookup);
  // A camera without an attitude of its own has the show's, and angles use neither of these.
  const bool by_file = !show.keys.track.empty();
  if ((is_euler(show.keys.attitude) || by_file) && !camera.find("look_at") &&
      !camera.find("euler_deg") && !camera.find("file"))
    for (const std::string_view key : {"roll_deg", "elevation_deg"})
      if (const Item* given = camera.find(key))
        given->fail(std::string("goes with look_at only; the show's camera is turned by ") +
                    (by_file ? "a file" : "euler_deg"));
  return own;
}

void read_named_cameras(const Item& item, ShowCamera& show, Lookup& lookup) {
  if (!item.node.IsMap()) {
    item.fail("must be a map of names and cameras, got " + kind_of(item));
    return;
  }
  for (const auto& [key, value] : entries_of(item))
    show.cameras[key] = read_further_camera(value, show, lookup);
}

}  // namespace

ShowCamera read_show_camera(const Section& show, const Show& to, Lookup& lookup) {
  const Section camera(show.find("camera"), {"camera"});
  ShowCamera result;
  result.frames_per_second = to.frames_per_second;
  for (const Body& body : to.bodies)
    result.bodies.emplace(body.name, std::make_shared<const Body>(body));
  result.projection = read_projection(show, camera);
  result.keys = read_camera_keys(camera, result, lookup);
  if (const auto fov = result.keys.values[Channel::kFov])
    result.projection = with_field_of_view(result.projection, *fov);
  if (const Item* cameras = show.find("cameras")) read_named_cameras(*cameras, result, lookup);
  return result;
}

CameraKeys read_camera(const Item& item, const ShowCamera& show, Lookup& lookup) {
  if (!item.node.IsScalar()) return read_further_camera(item, show, lookup);
  const auto* found =
      find_named(item, show.cameras, "names a camera that the show's `cameras` does not have");
  return found ? *found : CameraKeys{};
}

CameraKeys laid_over(CameraKeys keys, const CameraKeys& own) {
  const bool by_file = !own.track.empty();
  if (is_euler(own.attitude) || by_file)
    keys.values[Channel::kRoll] = keys.values[Channel::kElevation] = std::nullopt;
  if (own.attitude || by_file) keys.attitude = own.attitude, keys.track = own.track;
  if (own.frame) keys.frame = own.frame;
  lay_over(keys.values, own.values);
  return keys;
}

// The elevation has its default with Euler angles too, which do not use it, because a keyframe may
// turn from them to a target.
Camera camera_from(const CameraKeys& keys, const Projection& projection) {
  Camera camera{.attitude = keys.attitude.value_or(LookAtHole{}),
                .frame = keys.frame.value_or(CameraFrame::kHole),
                .roll = keys.values[Channel::kRoll].value_or(0)};
  constexpr double kDomeElevationDeg = 45;
  camera.elevation = keys.values[Channel::kElevation].value_or(
      has_zenith(projection) ? radians(kDomeElevationDeg) : 0);
  camera.dome_tilt = keys.values[Channel::kDomeTilt].value_or(0);
  return camera;
}

}  // namespace domefall
