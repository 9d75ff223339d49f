#include "pipeline/show/camera_section.h"

#include <array>

#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

constexpr double kDomeElevationDeg = 45, kFovDeg = 90;
constexpr int kFewestPixels = 16, kMostPixels = 16384;
constexpr Range kPixels = Range{"pixels"}.within(kFewestPixels, kMostPixels);
constexpr std::array<std::string_view, 4> kSizeNames{"1k", "2k", "4k", "8k"};

Domemaster read_dome(const Item* size) {
  Domemaster dome{4096};
  if (!size) return dome;
  if (!size->node.IsScalar()) {
    size->fail("must be 1k, 2k, 4k, 8k or a number of pixels (a domemaster is square), got " +
               kind_of(*size));
    return dome;
  }
  for (std::size_t k = 0; k < kSizeNames.size(); ++k)
    if (size->node.Scalar() == kSizeNames[k]) return {1024 << k};
  // Words and '3k' are told the names, numbers the bounds.
  if (size->node.Scalar().find_first_not_of("+-.0123456789") != std::string::npos)
    size->fail("must be 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384, got '" +
               shown(size->node.Scalar()) + "'" + did_you_mean(size->node.Scalar(), kSizeNames));
  else
    dome.size = read_whole_number(*size, kPixels).value_or(dome.size);
  return dome;
}

Stereographic read_flat(const Item* size, const Section& camera) {
  Stereographic flat{1920, 1080, 0};
  flat.fov = radians(camera.number("fov_deg", kDegrees.above(0).below(360), kFovDeg));
  if (!size) return flat;
  if (!size->node.IsSequence() || size->node.size() != 2) {
    size->fail("must be [width, height] in pixels (this projection is flat), got " +
               kind_of(*size));
    return flat;
  }
  const std::vector<Item> sides = *read_list(*size);
  flat.columns = read_whole_number(sides[0], kPixels).value_or(flat.columns);
  flat.rows = read_whole_number(sides[1], kPixels).value_or(flat.rows);
  return flat;
}

Projection read_projection(const Section& show, const Section& camera) {
  const Item* size = show.find("size");
  if (camera.choice("projection", {"domemaster", "stereographic"}) == std::size_t{1})
    return read_flat(size, camera);
  if (const Item* fov = camera.find("fov_deg"))
    fov->fail("goes with the stereographic projection only; a domemaster shows 180 degrees");
  return read_dome(size);
}

std::optional<Attitude> read_look_at(const Item& item, Lookup& lookup) {
  static constexpr std::array<std::string_view, 2> kWords{"hole", "motion"};
  if (item.node.IsScalar() && item.node.Scalar() == kWords[0]) return LookAtHole{};
  if (item.node.IsScalar() && item.node.Scalar() == kWords[1]) return LookAlongMotion{};
  if (const auto place = read_sky_place(item, lookup, kWords)) return LookAtSky{*place};
  return std::nullopt;
}

std::optional<Attitude> read_attitude(const Section& camera, Lookup& lookup) {
  for (const std::string_view key : {"look_at", "roll_deg", "elevation_deg"})
    camera.one_of({"euler_deg", key});
  if (const Item* euler = camera.find("euler_deg")) {
    const auto angle = read_numbers(*euler, 3, kDegrees.within(-3600, 3600));
    if (!angle) return std::nullopt;
    return EulerAngles{radians((*angle)[0]), radians((*angle)[1]), radians((*angle)[2])};
  }
  const Item* look_at = camera.find("look_at");
  return look_at ? read_look_at(*look_at, lookup) : std::nullopt;
}

std::optional<double> read_angle(const Section& camera, std::string_view key, double most) {
  const auto degrees = camera.number(key, kDegrees.within(-most, most));
  return degrees ? std::optional(radians(*degrees)) : std::nullopt;
}

CameraKeys read_keys(const Section& camera, const Projection& projection, Lookup& lookup) {
  CameraKeys keys;
  keys.attitude = read_attitude(camera, lookup);
  keys.roll = read_angle(camera, "roll_deg", 3600);
  keys.elevation = read_angle(camera, "elevation_deg", 90);
  keys.dome_tilt = read_angle(camera, "dome_tilt_deg", 90);
  if (!std::holds_alternative<Domemaster>(projection))
    for (const std::string_view key : {"elevation_deg", "dome_tilt_deg"})
      if (const Item* item = camera.find(key)) item->fail("is for domes; this projection is flat");
  return keys;
}

bool is_euler(const std::optional<Attitude>& attitude) {
  return attitude && std::holds_alternative<EulerAngles>(*attitude);
}

}  // namespace

ShowCamera read_show_camera(const Section& show, Lookup& lookup) {
  const Section camera = subsection(show, "camera",
                                    {"projection", "fov_deg", "look_at", "euler_deg", "roll_deg",
                                     "elevation_deg", "dome_tilt_deg"});
  ShowCamera result;
  result.projection = read_projection(show, camera);
  result.keys = read_keys(camera, result.projection, lookup);
  return result;
}

CameraKeys read_segment_camera(const Item* item, const ShowCamera& show, Lookup& lookup) {
  CameraKeys keys = show.keys;
  if (!item) return keys;
  const Section camera(*item, {"projection", "fov_deg", "look_at", "euler_deg", "roll_deg",
                               "elevation_deg", "dome_tilt_deg"});
  for (const std::string_view key : {"projection", "fov_deg"})
    if (const Item* fixed = camera.find(key))
      fixed->fail("holds for the whole show; it belongs in the show's own camera section");
  const CameraKeys own = read_keys(camera, show.projection, lookup);
  if (is_euler(own.attitude)) keys.roll = keys.elevation = std::nullopt;
  if (own.attitude) keys.attitude = own.attitude;
  if (is_euler(keys.attitude) && !camera.find("look_at") && !camera.find("euler_deg"))
    for (const std::string_view key : {"roll_deg", "elevation_deg"})
      if (const Item* given = camera.find(key))
        given->fail("goes with look_at only; the show's camera is turned by euler_deg");
  if (own.roll) keys.roll = own.roll;
  if (own.elevation) keys.elevation = own.elevation;
  if (own.dome_tilt) keys.dome_tilt = own.dome_tilt;
  return keys;
}

Camera camera_from(const CameraKeys& keys, const Projection& projection) {
  const bool look_at_on_dome =
      std::holds_alternative<Domemaster>(projection) && !is_euler(keys.attitude);
  Camera camera;
  camera.attitude = keys.attitude.value_or(LookAtHole{});
  camera.roll = keys.roll.value_or(0);
  camera.elevation = keys.elevation.value_or(look_at_on_dome ? radians(kDomeElevationDeg) : 0);
  camera.dome_tilt = keys.dome_tilt.value_or(0);
  return camera;
}

}  // namespace domefall
