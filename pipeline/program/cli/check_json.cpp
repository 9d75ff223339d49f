#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "pipeline/base/frame_rate.h"
#include "pipeline/program/cli/check_page.h"
#include "pipeline/show/observer_track.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

// Writes twelve digits, which are those that repeat on every machine.  An infinite value becomes
// null, because JSON has none.
Json rounded_json(double value) {
  return std::isfinite(value) ? Json::parse(fmt::format("{:.12g}", value)) : Json();
}

Json rounded_json(const std::optional<double>& value) {
  return value ? rounded_json(*value) : Json();
}

Json region_names(const std::vector<Visit>& visits) {
  Json names = Json::array();
  for (const Visit& v : visits) names.push_back(region_name(v.region, v.universe));
  return names;
}

// Tells where an extreme is.  `value` is what is reached there, in the unit of the page.
Json extreme(const std::optional<Extreme>& e, double value) {
  if (!e) return {};
  return {{"value", rounded_json(value)},
          {"time_s", rounded_json(e->time_s)},
          {"frame", e->frame},
          {"segment", e->segment + 1}};
}

Json extreme(const std::optional<Extreme>& e) { return extreme(e, e ? e->value : 0); }

Json json_of(const SegmentSurvey& s, const Spacetime& spacetime) {
  const bool flat = spacetime.is_flat();
  Json json = {{"type", s.type},
               {"begin_s", rounded_json(s.begin_s)},
               {"end_s", rounded_json(s.end_s)},
               {"dissolve_s", rounded_json(s.dissolve_s)},
               {"from_r", rounded_json(s.r_begin)},
               {"to_r", rounded_json(s.r_end)},
               {"closest", flat ? Json() : extreme(s.closest)}};
  if (spacetime.is<Wormhole>()) {
    json["from_l"] = rounded_json(s.l_begin);
    json["to_l"] = rounded_json(s.l_end);
  }
  if (!flat) {
    json["regions"] = region_names(s.visits);
    json["proper_time_m"] = rounded_json(s.proper_time);
  }
  json["proper_time_s"] = rounded_json(s.proper_time * spacetime.seconds_per_m());
  json[flat ? "time_lapse" : "rate_m_per_s"] = {rounded_json(s.rate_begin),
                                                rounded_json(s.rate_end)};
  return json;
}

Json json_of(const SegmentJoint& j) {
  return {{"segment", j.segment + 1},
          {"time_s", rounded_json(j.time_s)},
          {"dissolve_s", rounded_json(j.dissolve_s)},
          {"r_before", rounded_json(j.r_before)},
          {"r_after", rounded_json(j.r_after)},
          {"region_before", region_name(j.before.region, j.before.universe)},
          {"region_after", region_name(j.after.region, j.after.universe)},
          {"velocity_jump", rounded_json(j.speed)},
          {"rate_before", rounded_json(j.rate_before)},
          {"rate_after", rounded_json(j.rate_after)}};
}

Json json_of(const FrameLight& l) {
  return {{"frame", l.frame},
          {"time_s", rounded_json(l.time_s)},
          {"segment", l.segment + 1},
          {"ev", rounded_json(l.ev)},
          {"mean", rounded_json(l.mean)},
          {"percentile_99", rounded_json(l.percentile99)},
          {"part_at_white", rounded_json(l.white)}};
}

Json json_of(const RenderTime& t) {
  return {{"seconds", rounded_json(t.seconds)},
          {"frame_s", rounded_json(t.frame_s)},
          {"threads", t.threads}};
}

Json json_of(const DiskSize& d, const std::optional<DiskRoom>& room) {
  return {{"bytes", rounded_json(d.total())},
          {"frame_linear_bytes", rounded_json(d.linear)},
          {"frame_graded_bytes", rounded_json(d.graded)},
          {"measured", d.measured},
          {"free_bytes", room ? rounded_json(room->free) : Json()}};
}

Json json_of(const Show& show, const Marker& m) {
  return {{"name", m.name},
          {"time_s", rounded_json(m.at_s)},
          {"frame", nearest_frame(show, m.at_s)},
          {"segment", segment_at(show, m.at_s) + 1}};
}

Json json_of(const ShowWarning& w) {
  if (w.segment == kWholeShow)
    return {{"time_s", nullptr}, {"frame", nullptr}, {"segment", nullptr}, {"text", w.text}};
  return {{"time_s", rounded_json(w.time_s)},
          {"frame", w.frame},
          {"segment", w.segment + 1},
          {"text", w.text}};
}

void add_fades(const Fades& fades, Json& json) {
  json["fade_in_s"] = rounded_json(fades.in_s);
  json["fade_out_s"] = rounded_json(fades.out_s);
}

Json json_of_head(const CheckReport& report) {
  const Show& show = report.show;
  const bool graded = !report.display.empty();
  return {{"title", show.title},
          {"frames", frame_count(show)},
          {"frames_per_second", rounded_json(show.frames_per_second)},
          {"frame_rate", text_of(frame_rate_of(show.frames_per_second))},
          {"frames_per_second_written", rounded_json(show.written_rate)},
          {"duration_s", rounded_json(segment_times(show).back())},
          {"projection", projection_name(show.projection)},
          {"width", columns(show.projection)},
          {"height", rows(show.projection)},
          {"pixel_aspect", rounded_json(pixel_aspect(show.projection))},
          {"display", graded ? Json(report.display) : Json()},
          {"view", graded ? Json(report.view) : Json()},
          {"mass_solar", rounded_json(show.spacetime.solar_masses())}};
}

Json json_of(const CheckedSky& sky) {
  const SkySources& s = sky.sources;
  std::vector<int> segments = s.segments;
  for (int& segment : segments) ++segment;
  return {{"region", name_of(s.region)},
          {"segments", segments},
          {"black_cd_m2", rounded_json(sky.black)},
          {"map", s.map.empty() ? Json() : Json(s.map)},
          {"map_taken_as", s.taken.empty() ? Json() : Json(s.taken)},
          {"map_fainter_than", rounded_json(s.map_fainter_than)},
          {"catalogue", s.catalogue.empty() ? Json() : Json(s.catalogue)},
          {"stars", s.stars},
          {"faintest", s.stars > 0 ? rounded_json(s.faintest) : Json()},
          {"planets_year", rounded_json(s.planets_year)}};
}

void add_whole(const CheckReport& report, Json& json) {
  const ShowSurvey& survey = report.survey;
  if (!report.show.spacetime.is_flat()) json["regions"] = region_names(survey.visits);
  json["closest_r"] = extreme(survey.closest);
  const double celerity = survey.fastest ? survey.fastest->value : 0;
  const double gamma = std::hypot(1.0, celerity);
  json["fastest_speed"] = extreme(survey.fastest, celerity / gamma);
  json["fastest_lorentz_factor"] = extreme(survey.fastest, gamma);
  json["least_one_plus_z"] = extreme(survey.bluest);
  json["largest_one_plus_z"] = extreme(survey.reddest);
  json["brightest"] = json_of(report.light.brightest);
  json["darkest"] = json_of(report.light.darkest);
  json["render"] = report.time ? json_of(*report.time) : Json();
  json["disk"] = json_of(disk_size(report), report.room);
}

}  // namespace

std::string check_json(const CheckReport& report) {
  Json json = json_of_head(report);
  json["skies"] = Json::array();
  for (const CheckedSky& sky : report.skies) json["skies"].push_back(json_of(sky));
  add_fades(report.show.fades, json);
  json["segments"] = Json::array();
  for (std::size_t k = 0; k < report.survey.segments.size(); ++k) {
    json["segments"].push_back(json_of(report.survey.segments[k], report.show.spacetime));
    add_fades(report.show.timeline[k].fades, json["segments"].back());
  }
  json["markers"] = Json::array();
  for (const Marker& m : report.show.markers) json["markers"].push_back(json_of(report.show, m));
  json["joints"] = Json::array();
  for (const SegmentJoint& j : report.joints) json["joints"].push_back(json_of(j));
  add_whole(report, json);
  json["warnings"] = Json::array();
  for (const ShowWarning& w : report.warnings) json["warnings"].push_back(json_of(w));
  // A grading configuration may name its displays in bytes that are not UTF-8.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace domefall
