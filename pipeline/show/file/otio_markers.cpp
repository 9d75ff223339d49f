#include "pipeline/show/file/otio_markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

using Json = nlohmann::json;
using Place = Json::json_pointer;

class OtioReader {
 public:
  OtioReader(const std::filesystem::path& file, const Json& root) : file_(file), root_(root) {}

  std::vector<Marker> read() {
    if (schema(Place()) != "Timeline")
      fail(Place(), "is no OTIO timeline (OTIO_SCHEMA Timeline.1)");
    const Place stack = Place("/tracks");
    const double begin = range_start(stack);
    add_markers(stack, 0, begin);
    const std::size_t tracks = count(stack / "children");
    for (std::size_t k = 0; k < tracks; ++k) read_track(stack / "children" / k, begin);
    std::ranges::stable_sort(found_, {}, &Marker::at_s);
    return found_;
  }

 private:
  [[noreturn]] void fail(const Place& at, const std::string& what) const {
    throw InputError(file_.string() + ": " + (at.empty() ? "it" : at.to_string()) + " " + what);
  }

  const Json* find(const Place& at) const {
    return root_.contains(at) && !root_.at(at).is_null() ? &root_.at(at) : nullptr;
  }

  std::size_t count(const Place& at) const {
    const Json* list = find(at);
    if (list && !list->is_array()) fail(at, "must be a list");
    return list ? list->size() : 0;
  }

  std::string text(const Place& at) const {
    const Json* value = find(at);
    return value && value->is_string() ? value->get<std::string>() : "";
  }

  std::string schema(const Place& at) const {
    const std::string name = text(at / "OTIO_SCHEMA");
    return name.substr(0, name.find('.'));
  }

  double number(const Place& at) const {
    const Json* value = find(at);
    if (!value || !value->is_number() || !std::isfinite(value->get<double>()))
      fail(at, "must be a number");
    return value->get<double>();
  }

  double seconds(const Place& at) const {
    const double rate = number(at / "rate");
    if (!(rate > 0)) fail(at / "rate", "must be above 0");
    return number(at / "value") / rate;
  }

  double range_start(const Place& item) const {
    const Place range = item / "source_range";
    return find(range) ? seconds(range / "start_time") : 0;
  }

  // A clip without a range of its own is as long as its media.
  double length(const Place& item) const {
    if (find(item / "source_range")) return seconds(item / "source_range" / "duration");
    Place media = item / "media_reference";
    if (!find(media)) {
      const std::string key = text(item / "active_media_reference_key");
      media = item / "media_references" / (key.empty() ? "DEFAULT_MEDIA" : key);
    }
    if (!find(media / "available_range"))
      fail(item, "has no source_range, and its media have no available_range");
    return seconds(media / "available_range" / "duration");
  }

  // Adds the markers of an item that begins at `begin` with its own time `start`.
  void add_markers(const Place& item, double begin, double start) {
    const Place list = item / "markers";
    for (std::size_t k = 0; k < count(list); ++k)
      add(text(list / k / "name"), "marker",
          begin + seconds(list / k / "marked_range" / "start_time") - start);
  }

  void read_track(const Place& track, double stack_start) {
    if (schema(track) != "Track") fail(track, "must be a track (OTIO_SCHEMA Track.1)");
    const double start = range_start(track);
    add_markers(track, -stack_start, start);
    double at = -stack_start - start;
    const Place children = track / "children";
    for (std::size_t k = 0; k < count(children); ++k) {
      const Place item = children / k;
      const std::string kind = schema(item);
      if (kind == "Transition") continue;  // lies over its neighbours
      if (kind != "Clip" && kind != "Gap")
        fail(item, "must be a clip, a gap or a transition, got '" + text(item / "OTIO_SCHEMA") +
                       "'; flatten nested tracks first");
      if (kind == "Clip") add(text(item / "name"), "cut", at);
      add_markers(item, at, range_start(item));
      at += length(item);
    }
  }

  // What was cut off before the beginning is no instant of the show.
  void add(const std::string& name, const char* kind, double at) {
    constexpr double kRounding = 1e-9;
    if (at < -kRounding) return;
    const std::string base = name.empty() ? kind : name;
    std::string unused = base;
    for (int k = 2; !names_.insert(unused).second; ++k) unused = fmt::format("{} {}", base, k);
    found_.push_back({unused, std::max(at, 0.0)});
  }

  const std::filesystem::path& file_;
  const Json& root_;
  std::vector<Marker> found_;
  std::set<std::string> names_;
};

}  // namespace

std::vector<Marker> read_otio_markers(const std::filesystem::path& file) {
  constexpr std::uint64_t kMost = 64 << 20;
  const std::string text = read_file(file, kMost);
  // A hostile depth would end the parser's stack.
  const auto shallow = [](int depth, Json::parse_event_t, Json&) {
    constexpr int kDeepest = 64;
    if (depth > kDeepest) throw InputError("it is nested too deeply");
    return true;
  };
  try {
    const Json root = Json::parse(text, shallow);
    return OtioReader(file, root).read();
  } catch (const Json::exception& error) {
    throw InputError(file.string() + ": no JSON of OpenTimelineIO: " + error.what());
  }
}

}  // namespace domefall
