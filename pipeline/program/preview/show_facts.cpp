#include "pipeline/program/preview/show_facts.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/base/digest.h"
#include "pipeline/grade/view_transform.h"
#include "pipeline/program/diagram/page.h"
#include "pipeline/program/survey/axis_stars.h"
#include "pipeline/program/survey/body_motion.h"
#include "pipeline/program/survey/light_survey.h"
#include "pipeline/program/survey/show_jumps.h"
#include "pipeline/program/survey/show_warnings.h"
#include "pipeline/render/file_stamp.h"
#include "pipeline/render/frame_bands.h"
#include "pipeline/render/rays/shift_range.h"
#include "pipeline/show/observer_track.h"
#include "pipeline/show/show.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostCurveSamples = 2000;

// Returns the six digits that a page shows.  JSON has no infinity, for which this returns null.
Json rounded_number(double value) {
  if (!std::isfinite(value)) return {};
  return Json::parse(fmt::format("{:.6g}", value));
}

Json segments_of(const Show& show) {
  const std::vector<double> times = segment_times(show);
  Json list = Json::array();
  for (std::size_t k = 0; k < show.timeline.size(); ++k) {
    const Segment& segment = show.timeline[k];
    list.push_back({{"type", segment.type},
                    {"begin_s", rounded_number(times[k])},
                    {"end_s", rounded_number(times[k] + segment.duration_s)},
                    {"dissolve_s", rounded_number(segment.dissolve_s)},
                    {"fade_in_s", rounded_number(segment.fades.in_s)},
                    {"fade_out_s", rounded_number(segment.fades.out_s)}});
  }
  return list;
}

// Returns the section that a key is in.  Keys of the camera stand alone.
std::string section_of(const std::string& key) {
  const std::size_t end = key.find('.');
  return end == std::string::npos ? "camera" : key.substr(0, end);
}

// Returns each instant at which something is keyframed, once for each section, because keyframes of
// the show stand in each of its segments.
Json keyframes_of(const Show& show) {
  std::set<std::pair<double, std::string>> keys;
  const double end = end_of(show);
  for (const Segment& segment : show.timeline) {
    for (const AttitudeKey& key : segment.attitudes) keys.emplace(key.at_s, "camera");
    for (const auto& [name, curve] : curves_of(show, segment))
      if (curve->keys.size() > 1)
        for (const CurveKey& key : curve->keys) keys.emplace(key.at_s, section_of(name));
  }
  Json list = Json::array();
  for (const auto& [at_s, what] : keys)
    if (at_s >= 0 && at_s <= end)
      list.push_back({{"time_s", rounded_number(at_s)},
                      {"segment", segment_at(show, at_s) + 1},
                      {"what", what}});
  return list;
}

Json markers_of(const Show& show) {
  Json list = Json::array();
  for (const Marker& marker : show.markers)
    list.push_back({{"name", marker.name}, {"time_s", rounded_number(marker.at_s)}});
  return list;
}

Json titles_of(const Show& show) {
  Json list = Json::array();
  const auto add = [&](const std::vector<Title>& titles) {
    for (const Title& title : titles)
      list.push_back({{"text", title.text},
                      {"begin_s", rounded_number(title.begin_s)},
                      {"end_s", rounded_number(title.end_s)}});
  };
  add(show.titles);
  for (const Segment& segment : show.timeline) add(segment.titles);
  return list;
}

// Returns the speed against an observer at rest, or inside the horizon against one who falls
// freely.
double shown_speed(const ObserverState& o) {
  return speed_of(has_rest(o) ? static_celerity(o).length() : o.celerity.length());
}

Json states_of(const Show& show) {
  const int count = frame_count(show), samples = std::min(count, kMostCurveSamples);
  Json frames = Json::array(), r = Json::array(), regions = Json::array(), clocks = Json::array(),
       speeds = Json::array(), shifts = Json::array();
  for (int k = 0; k < samples; ++k) {
    const int frame =
        samples > 1 ? static_cast<int>(std::int64_t{k} * (count - 1) / (samples - 1)) : 0;
    const FrameState state = frame_state(show, frame);
    const ObserverState& o = dominant_view(state).observer;
    frames.push_back(frame);
    r.push_back(rounded_number(o.r));
    regions.push_back(is_flat(o) ? Json() : Json(region_name(o.region, o.universe)));
    clocks.push_back(rounded_number(o.proper_time));
    speeds.push_back(rounded_number(shown_speed(o)));
    const auto shift = frequency_range(o, own_sky(o), !show.effects.lensing);
    shifts.push_back(shift ? rounded_number(1 / shift->largest) : Json());
  }
  return {{"frame", frames},       {"r", r},          {"region", regions},
          {"proper_time", clocks}, {"speed", speeds}, {"shift_ahead", shifts}};
}

Json plots_of(const Show& show) {
  const MarkedPage page = marked_page(show, std::clamp(frame_count(show), 2, kMostCurveSamples));
  Json marks = Json::array();
  for (const std::vector<PagePoint>& places : page.places) {
    Json at = Json::array();
    for (const PagePoint& p : places) {
      at.push_back(std::round(10 * p.x) / 10);
      at.push_back(std::round(10 * p.y) / 10);
    }
    marks.push_back(at);
  }
  return {
      {"width", page.width}, {"height", page.height}, {"step_s", page.step_s}, {"marks", marks}};
}

Json effects_of(const Effects& effects) {
  Json json;
  for (const auto& [name, effect] : kEffectSwitches) json[std::string(name)] = effects.*effect;
  for (const auto& [name, amplification] : kAmplifications)
    if (amplification == effects.amplification) json["amplification"] = name;
  return json;
}

Json displays_as_json(const Show& show) {
  Json displays = Json::object();
  for (const DisplayViews& display : displays_of(show.grade.config))
    displays[display.display] = display.views;
  return displays;
}

Json sound_stamp(const Show& show) {
  if (show.audio.empty()) return {};
  Digest digest;
  digest.add(frame_count(show)).add(show.frames_per_second);
  for (const std::filesystem::path& file : show.audio) {
    const FileStamp stamp(file);
    digest.add(file.string()).add(fmt::to_string(stamp.number));
    digest.add(fmt::format("{}.{:09}", stamp.changed_s, stamp.changed_ns));
  }
  return digest.hex();
}

Json overlays_as_json() {
  Json names = Json::array();
  for (const auto& [kind, name] : kOverlays) names.push_back(name);
  return names;
}

Json warning_json(const ShowWarning& warning) {
  Json json = {{"time_s", nullptr}, {"frame", nullptr}, {"segment", nullptr}};
  if (warning.segment != kWholeShow)
    json = {{"time_s", rounded_number(warning.time_s)},
            {"frame", warning.frame},
            {"segment", warning.segment + 1}};
  json["text"] = warning.text;
  return json;
}

ShowWarning light_warning(const FrameLight& light, const char* text) {
  return {light.time_s, light.frame, light.segment, text};
}

// A configuration's names may hold bytes that are not UTF-8, which must not end the page.
std::string page_json(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// A version of the show must stay as it is for this long, so that not every save of a series is
// examined.
constexpr int kCalmSeconds = 2;

// Returns nothing, and early, once `stop` is set.
std::string show_warnings_as_json(const Show& show, const std::atomic<bool>& stop) {
  std::vector<ShowWarning> warnings = jump_warnings(show);
  AxisStars axis(show);
  NearBodies bodies(show);
  NearGas gas(show);
  for (int frame = 0; frame < frame_count(show); ++frame) {
    if (stop) return {};
    const FrameState state = frame_state(show, frame);
    axis.add(state);
    bodies.add(state);
    gas.add(state);
  }
  for (const ShowWarning& warning : axis.warnings()) warnings.push_back(warning);
  for (const ShowWarning& warning : bodies.warnings()) warnings.push_back(warning);
  for (const ShowWarning& warning : gas.warnings()) warnings.push_back(warning);
  for (const ShowWarning& warning : horizon_warnings(show)) warnings.push_back(warning);
  for (const ShowWarning& warning : place_warnings(show)) warnings.push_back(warning);
  for (const ShowWarning& warning : body_warnings(show)) warnings.push_back(warning);
  for (const ShowWarning& warning : title_warnings(show)) warnings.push_back(warning);
  Renderer renderer(show, 1, {}, kSurveyDetail);
  renderer.stop_when(&stop);
  try {
    const LightSurvey light = survey_light(show, renderer, nullptr);
    warnings.push_back(light_warning(light.brightest, "here the show is brightest"));
    warnings.push_back(light_warning(light.darkest, "here the show is darkest"));
  } catch (const RenderStopped&) {
    return {};
  }
  std::ranges::stable_sort(warnings, {}, &ShowWarning::time_s);
  Json list = Json::array();
  for (const ShowWarning& warning : warnings) list.push_back(warning_json(warning));
  return page_json({{"done", true}, {"warnings", list}});
}

// Names the skies that a show of this kind may see.
Json skies_as_json(const Show& show) {
  const auto* charged = std::get_if<ChargedHole>(&show.spacetime.kind());
  Json names = Json::array({"I"});
  if (!show.spacetime.is_flat() && !(charged && charged->is_naked())) names.push_back("III");
  if (show.spacetime.is<Schwarzschild>()) names.push_back("IV");
  if (show.spacetime.leads_on()) names.push_back("next");
  return names;
}

std::string no_warnings_as_json(bool done) {
  return page_json({{"done", done}, {"warnings", Json::array()}});
}

}  // namespace

std::string show_facts(const LiveShow::Version& version, int threads) {
  const Show& show = *version.show;
  const auto mass = show.spacetime.solar_masses();
  Json json = {{"revision", version.revision},
               {"file", show.file.filename().string()},
               {"title", show.title},
               {"frames", frame_count(show)},
               {"frames_per_second", show.frames_per_second},
               {"duration_s", rounded_number(end_of(show))},
               {"mistake", version.mistake.empty() ? Json() : Json(version.mistake)},
               {"projection", projection_name(show.projection)},
               {"width", columns(show.projection)},
               {"height", rows(show.projection)},
               {"mass_solar", mass ? rounded_number(*mass) : Json()},
               {"default_view", Stereographic::kTraits.name},
               {"threads", threads},
               {"segments", segments_of(show)},
               {"keyframes", keyframes_of(show)},
               {"markers", markers_of(show)},
               {"titles", titles_of(show)},
               {"sound", sound_stamp(show)},
               {"displays", displays_as_json(show)},
               {"display", version.display},
               {"view", version.view},
               {"effects", effects_of(show.effects)},
               {"skies", skies_as_json(show)},
               {"overlays", overlays_as_json()},
               {"states", states_of(show)},
               {"plots", plots_of(show)}};
  return page_json(json);
}

WarningFinder::WarningFinder(LiveShow& show) : show_(show), finding_([this] { find(); }) {}

WarningFinder::~WarningFinder() {
  stop_ = true;
  show_.stop();
  finding_.join();
}

std::string WarningFinder::as_json() const {
  const std::lock_guard lock(mutex_);
  if (revision_ != show_.version().revision) return no_warnings_as_json(false);
  return found_;
}

void WarningFinder::find() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 19);  // pictures come first
  LiveShow::Version version = show_.version();
  while (!stop_) {
    const LiveShow::Version later = show_.changed_since(version.readings, kCalmSeconds);
    const bool calm = later.readings == version.readings;
    version = later;
    bool known = false;
    {
      const std::lock_guard lock(mutex_);
      known = revision_ == version.revision;
    }
    if (!calm || known || stop_) continue;
    std::string found;
    try {
      found = show_warnings_as_json(*version.show, stop_);
    } catch (const std::exception&) {
      // What cannot be read now is told where a picture needs it.
      found = no_warnings_as_json(true);
    }
    const std::lock_guard lock(mutex_);
    revision_ = version.revision;
    found_ = std::move(found);
  }
}

}  // namespace domefall
