#include "pipeline/cli/sky_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/cli/json_number.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

bool is_thermal(const SkyFile& file) { return file.map().kind() == SkyMapKind::kThermal; }

const char* unit_name(const SkyFile& file) { return is_thermal(file) ? "W/m^2/sr" : "cd/m^2"; }

Json json_of_picture(const Orientation& o) {
  return {{"frame", o.frame == SkyFrame::kGalactic ? "galactic" : "equatorial"},
          {"longitude_grows", o.longitude_right ? "right" : "left"},
          {"up", o.south_up ? "south" : "north"},
          {"centre_deg", json_number(o.centre_deg)}};
}

}  // namespace

std::string sky_page(const SkyFile& file) {
  const auto& levels = file.map().levels();
  return fmt::format(
      "kind         {}\n"
      "unit         {:.9g} {}\n"
      "faces        6 of {} x {}, {} levels, {:.1f} MB\n"
      "picture      {}\n"
      "{}",
      is_thermal(file) ? "thermal: radiance and temperature" : "colour: working-space RGB",
      file.map().unit(), unit_name(file), levels[0].size, levels[0].size, levels.size(),
      static_cast<double>(file.map().bytes()) / 1e6,
      file.origin().panorama ? orientation_phrase(*file.origin().panorama) : "none",
      file.origin().text);
}

std::string sky_json(const SkyFile& file, bool verified) {
  const SkyOrigin& origin = file.origin();
  const Json json = {
      {"kind", is_thermal(file) ? "thermal" : "colour"},
      {"unit", json_number(file.map().unit())},
      {"unit_name", unit_name(file)},
      {"face_size", file.map().levels()[0].size},
      {"levels", file.map().levels().size()},
      {"bytes", file.map().bytes()},
      {"picture", origin.panorama ? json_of_picture(*origin.panorama) : Json()},
      {"fainter_than", origin.fainter_than ? json_number(*origin.fainter_than) : Json()},
      {"text", origin.text},
      {"digest", file.digest()},
      {"verified", verified ? Json(true) : Json()}};
  // The text in another program's file need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace domefall
