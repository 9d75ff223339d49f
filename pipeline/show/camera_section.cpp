#include "pipeline/show/camera_section.h"

#include <fmt/format.h>

#include <array>

#include "pipeline/show/known_name.h"
#include "pipeline/show/projection_section.h"

namespace domefall {
namespace {

constexpr double kDomeElevationDeg = 45;  // default of elevation_deg

constexpr std::array<std::string_view, 8> kKeys{"projection",    "cut",          "fov_deg",
                                                "look_at",       "euler_deg",    "roll_deg",
                                                "elevation_deg", "dome_tilt_deg"};

// Reads {keyframe: NAME}, which takes over the attitude of the keyframe that bears the name.
std::optional<Attitude> read_other_keyframe(const Item& item, const NamedCameras& named) {
  const Attitude* attitude =
      find_named(Section(item, {"keyframe"}), "keyframe", named.keyframes,
                 "names no keyframe before this one that has a name and a direction");
  return attitude ? std::optional(*attitude) : std::nullopt;
}

// Reads {body: NAME}, which looks at that body.
std::optional<Attitude> read_body_target(const Item& item, const NamedCameras& named) {
  const auto* body =
      find_named(Section(item, {"body"}), "body", named.bodies, "names no body of the show");
  return body ? std::optional<Attitude>(LookAtBody{*body}) : std::nullopt;
}

// Reads a target, which is a word, another keyframe's, a body or a place on the sky.  The words
// come before names of places, so that no star of such a name is meant.
std::optional<Attitude> read_look_at(const Item& item, const NamedCameras& named, Lookup& lookup) {
  static const Words<Attitude, 3> kWords{
      {{"hole", LookAtHole{}}, {"motion", LookAlongMotion{}}, {"outward", LookOutward{}}}};
  if (auto attitude = meaning(item, kWords)) return attitude;
  if (peek(item, "keyframe")) return read_other_keyframe(item, named);
  if (peek(item, "body")) return read_body_target(item, named);
  if (const auto place = read_sky_place(item, lookup, names_of(kWords))) return LookAtSky{*place};
  return std::nullopt;
}

// Reads the attitude.  Euler angles exclude the keys that say where a target stands.
std::optional<Attitude> read_attitude(const Section& camera, const NamedCameras& named,
                                      Lookup& lookup) {
  // The three angles say all of an attitude, so none of these keys has anything left to say.
  for (const std::string_view key : {"look_at", "roll_deg", "elevation_deg"})
    camera.one_of({"euler_deg", key});
  if (const Item* euler = camera.find("euler_deg")) {
    const auto angle = read_numbers(*euler, 3, kDegrees.within(-3600, 3600));
    if (!angle) return std::nullopt;
    return EulerAngles{radians((*angle)[0]), radians((*angle)[1]), radians((*angle)[2])};
  }
  const Item* look_at = camera.find("look_at");
  return look_at ? read_look_at(*look_at, named, lookup) : std::nullopt;
}

// Reads an angle in degrees and returns it in radians.
std::optional<double> read_angle(const Section& camera, std::string_view key, const Range& range) {
  const auto degrees = camera.number(key, range);
  return degrees ? std::optional(radians(*degrees)) : std::nullopt;
}

// Reads the keys that every camera may have.  Which of them make sense depends on the projection.
CameraKeys read_camera_keys(const Section& camera, const Projection& projection,
                            const NamedCameras& named, Lookup& lookup) {
  CameraKeys keys;
  keys.attitude = read_attitude(camera, named, lookup);
  // A roll may be ten turns either way, since keyframes change it as a number and may spin the
  // image.
  keys.values[Channel::kRoll] = read_angle(camera, "roll_deg", kDegrees.within(-3600, 3600));
  keys.values[Channel::kElevation] = read_angle(camera, "elevation_deg", kDegrees.within(-90, 90));
  keys.values[Channel::kDomeTilt] = read_angle(camera, "dome_tilt_deg", kDegrees.within(-90, 90));
  const bool zenith = has_zenith(projection);
  // A flat image has its target in the middle, where neither a rim nor a tilt moves it.
  for (const std::string_view key : {"elevation_deg", "dome_tilt_deg"})
    if (const Item* item = camera.find(key); item && !zenith)
      item->fail("is for domes; this projection is flat");
  // A projection that shows a fixed part of the sphere has no range.
  if (const auto range = fov_range(projection))
    keys.values[Channel::kFov] = read_angle(camera, "fov_deg", *range);
  else if (const Item* fov = camera.find("fov_deg"))
    fov->fail(fmt::format(
        "goes with the projections fisheye, stereographic and rectilinear; {} {} shows {} degrees",
        std::holds_alternative<Equirectangular>(projection) ? "an" : "a",
        projection_name(projection), std::holds_alternative<Domemaster>(projection) ? 180 : 360));
  return keys;
}

bool is_euler(const std::optional<Attitude>& attitude) {
  return attitude && std::holds_alternative<EulerAngles>(*attitude);
}

// Reads a camera other than the show's own, which alone gives the projection.
CameraKeys read_further_camera(const Item& item, const ShowCamera& show, Lookup& lookup) {
  const Section camera(item, kKeys);
  for (const std::string_view key : {"projection", "cut"})
    if (const Item* fixed = camera.find(key))
      fixed->fail("holds for the whole show; it belongs in the show's own camera section");
  // The show's projection decides which keys make sense here too.
  CameraKeys own = read_camera_keys(camera, show.projection, show.named, lookup);
  // A camera without an attitude of its own has the show's, and Euler angles use neither of these.
  if (is_euler(show.keys.attitude) && !camera.find("look_at") && !camera.find("euler_deg"))
    for (const std::string_view key : {"roll_deg", "elevation_deg"})
      if (const Item* given = camera.find(key))
        given->fail("goes with look_at only; the show's camera is turned by euler_deg");
  return own;
}

// Reads the show's `cameras`, which segments and keyframes name.
void read_named_cameras(const Item& item, ShowCamera& show, Lookup& lookup) {
  if (!item.node.IsMap()) {
    item.fail("must be a map of names and cameras, got " + kind_of(item));
    return;
  }
  for (const auto& [key, value] : entries_of(item))
    show.named.cameras[key] = read_further_camera(value, show, lookup);
}

}  // namespace

ShowCamera read_show_camera(const Section& show, const std::vector<Body>& bodies, Lookup& lookup) {
  const Section camera = subsection(show, "camera", kKeys);
  ShowCamera result;
  // Attitudes are copied into segments and keyframes, and all copies share one body.
  for (const Body& body : bodies)
    result.named.bodies.emplace(body.name, std::make_shared<const Body>(body));
  result.projection = read_projection(show, camera);
  result.keys = read_camera_keys(camera, result.projection, result.named, lookup);
  if (const auto fov = result.keys.values[Channel::kFov])
    result.projection = with_field_of_view(result.projection, *fov);
  // The named cameras come last, since they are checked against the show's own.
  if (const Item* cameras = show.find("cameras")) read_named_cameras(*cameras, result, lookup);
  return result;
}

CameraKeys read_camera(const Item& item, const ShowCamera& show, Lookup& lookup) {
  if (!item.node.IsScalar()) return read_further_camera(item, show, lookup);
  const auto name = read_text(item);
  if (!name) return {};
  // A name that is not known leaves empty keys, with which the show's own camera stays.
  const auto found = show.named.cameras.find(*name);
  if (found != show.named.cameras.end()) return found->second;
  std::vector<std::string_view> known;
  for (const auto& [key, camera] : show.named.cameras) known.push_back(key);
  item.fail("names a camera that the show's `cameras` does not have: '" + shown(*name) + "'" +
            did_you_mean(*name, known));
  return {};
}

CameraKeys laid_over(CameraKeys keys, const CameraKeys& own) {
  if (is_euler(own.attitude))
    keys.values[Channel::kRoll] = keys.values[Channel::kElevation] = std::nullopt;
  if (own.attitude) keys.attitude = own.attitude;
  lay_over(keys.values, own.values);
  return keys;
}

// The elevation has its default with Euler angles too, which do not use it, because a keyframe may
// turn from them to a target.
Camera camera_from(const CameraKeys& keys, const Projection& projection) {
  Camera camera;
  camera.attitude = keys.attitude.value_or(LookAtHole{});
  camera.roll = keys.values[Channel::kRoll].value_or(0);
  camera.elevation = keys.values[Channel::kElevation].value_or(
      has_zenith(projection) ? radians(kDomeElevationDeg) : 0);
  camera.dome_tilt = keys.values[Channel::kDomeTilt].value_or(0);
  return camera;
}

}  // namespace domefall
