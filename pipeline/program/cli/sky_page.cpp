#include "pipeline/program/cli/sky_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "trajectories/equatorial.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

bool is_thermal(const SkyFile& file) { return file.map().kind() == SkyMapKind::kThermal; }

const char* unit_name(const SkyFile& file) { return is_thermal(file) ? "W/m^2/sr" : "cd/m^2"; }

Json json_of_picture(const Orientation& o) {
  return {{"frame", o.frame == SkyFrame::kGalactic ? "galactic" : "equatorial"},
          {"longitude_grows", o.longitude_right ? "right" : "left"},
          {"up", o.south_up ? "south" : "north"},
          {"centre_deg", o.centre_deg}};
}

constexpr std::size_t kOthersShown = 4;

void print_fit(const char* what, const OrientationFit& fit) {
  fmt::print("{:7} {:5.0f} %  {:5.0f} %  {:6.3f}   {}\n", what, 100 * fit.stars, 100 * fit.clouds,
             fit.band, orientation_phrase(fit.orientation));
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

std::string picture_page(const std::string& taken, bool json) {
  if (!json) return fmt::format("kind         picture\ntaken as     {}\n", taken);
  return Json{{"kind", "picture"}, {"taken_as", taken}}.dump(2, ' ', false,
                                                             Json::error_handler_t::replace) +
         "\n";
}

std::string sky_json(const SkyFile& file, bool verified) {
  const SkyOrigin& origin = file.origin();
  const Json json = {{"kind", is_thermal(file) ? "thermal" : "colour"},
                     {"unit", file.map().unit()},
                     {"unit_name", unit_name(file)},
                     {"face_size", file.map().levels()[0].size},
                     {"levels", file.map().levels().size()},
                     {"bytes", file.map().bytes()},
                     {"picture", origin.panorama ? json_of_picture(*origin.panorama) : Json()},
                     {"fainter_than", origin.fainter_than ? Json(*origin.fainter_than) : Json()},
                     {"text", origin.text},
                     {"digest", file.digest()},
                     {"verified", verified ? Json(true) : Json()}};
  // The text in another program's file need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string verdict_sentence(const SkyCheck& check) {
  const std::string_view by = check.by_stars ? "by its stars" : "by its Milky Way";
  const std::string stated = orientation_phrase(check.stated.orientation);
  if (check.verdict == SkyVerdict::kAgrees)
    return fmt::format("it lies on the sky as stated, {}: {}", by, stated);
  if (check.verdict == SkyVerdict::kOther)
    return fmt::format("stated as {}, but, {}, it fits better as {}", stated, by,
                       orientation_phrase(check.others[0].orientation));
  return "neither its stars nor its Milky Way are clear enough to tell its orientation by";
}

void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places) {
  fmt::print("place                      RA deg  Dec deg  light over its surroundings\n");
  for (const KnownPlace& p : places) {
    const Equatorial at = equatorial(p.direction);
    fmt::print("{:25} {:7.2f}  {:7.2f}  {:.3g}\n", p.name, at.ra_deg, at.dec_deg, p.contrast);
  }
  fmt::print("\n         stars   clouds  band     orientation\n");
  print_fit("stated", check.stated);
  for (std::size_t k = 0; k < std::min(kOthersShown, check.others.size()); ++k)
    print_fit("other", check.others[k]);
}

}  // namespace domefall
