#include "pipeline/theatre/timeline/timeline_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "pipeline/base/frame_rate.h"
#include "pipeline/show/title_text.h"

namespace domefall {
namespace {

using Json = nlohmann::ordered_json;

int frame_at(const Show& show, double seconds) {
  constexpr double kRounding = 1e-6;  // of a frame, in sums of seconds
  return static_cast<int>(std::ceil(seconds * show.frames_per_second - kRounding));
}

Json schema(const char* name, Json members) {
  Json json = {{"OTIO_SCHEMA", name}, {"metadata", Json::object()}};
  json.update(members);
  return json;
}

// Times are whole frames at the show's rate.
class OtioWriter {
 public:
  OtioWriter(const Show& show, const FrameFolder& folder)
      : show_(show),
        rate_(per_second(frame_rate_of(show.frames_per_second))),
        frames_(frame_count(show)),
        media_(media(folder)) {}

  std::string text() const {
    Json children = Json::array();
    double end = 0;
    for (std::size_t k = 0; k < show_.timeline.size(); ++k) {
      const Segment& segment = show_.timeline[k];
      const double begin = end - segment.dissolve_s;
      end = begin + segment.duration_s;
      const bool last = k + 1 == show_.timeline.size();
      // In a dissolve the picture changes hands in the middle.
      const double cut = begin + segment.dissolve_s / 2,
                   next = last ? end : end - show_.timeline[k + 1].dissolve_s / 2;
      if (segment.dissolve_s > 0) children.push_back(transition(begin, cut, segment.dissolve_s));
      children.push_back(clip(k, frame_at(show_, cut), last ? frames_ : frame_at(show_, next)));
    }
    const Json track = schema("Track.1", {{"name", "Frames"},
                                          {"source_range", nullptr},
                                          {"effects", Json::array()},
                                          {"markers", Json::array()},
                                          {"enabled", true},
                                          {"children", std::move(children)},
                                          {"kind", "Video"}});
    const Json stack = schema("Stack.1", {{"name", "tracks"},
                                          {"source_range", nullptr},
                                          {"effects", Json::array()},
                                          {"markers", markers()},
                                          {"enabled", true},
                                          {"children", Json::array({track})}});
    return schema("Timeline.1",
                  {{"name", show_.title}, {"global_start_time", nullptr}, {"tracks", stack}})
               .dump(2, ' ', false, Json::error_handler_t::replace) +
           "\n";
  }

 private:
  Json time(int frames) const {
    return {{"OTIO_SCHEMA", "RationalTime.1"}, {"rate", rate_}, {"value", double(frames)}};
  }
  Json range(int first, int count) const {
    return {{"OTIO_SCHEMA", "TimeRange.1"}, {"duration", time(count)}, {"start_time", time(first)}};
  }

  // The frames of folders with a part of them each are no sequence for other programs.
  Json media(const FrameFolder& folder) const {
    const FrameNames& names = show_.output.names;
    if (names.per_folder > 0)
      return schema("MissingReference.1", {{"name", ""}, {"available_range", range(0, frames_)}});
    const auto file =
        std::filesystem::absolute(folder.has_graded() ? folder.graded(0) : folder.linear(0));
    std::string prefix = file.stem().string();
    prefix.erase(prefix.find_last_not_of("0123456789") + 1);
    return schema("ImageSequenceReference.1",
                  {{"name", ""},
                   {"available_range", range(0, frames_)},
                   {"available_image_bounds", nullptr},
                   {"target_url_base", "file://" + escaped(file.parent_path().string()) + "/"},
                   {"name_prefix", prefix},
                   {"name_suffix", file.extension().string()},
                   {"start_frame", names.start},
                   {"frame_step", 1},
                   {"rate", rate_},
                   {"frame_zero_padding", names.digits},
                   {"missing_frame_policy", "error"}});
  }

  // Escapes what RFC 3986 does not let stand in the path of a URL.
  static std::string escaped(const std::string& path) {
    std::string url;
    for (const char c : path) {
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') ||
                         std::string_view("/-._~").find(c) != std::string_view::npos;
      url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return url;
  }

  Json clip(std::size_t segment, int first, int end) const {
    const std::string& type = show_.timeline[segment].type;
    return schema("Clip.2",
                  {{"metadata", {{"domefall", {{"segment", segment + 1}, {"type", type}}}}},
                   {"name", fmt::format("{} {}", segment + 1, type)},
                   {"source_range", range(first, end - first)},
                   {"effects", Json::array()},
                   {"markers", Json::array()},
                   {"enabled", true},
                   {"media_references", {{"DEFAULT_MEDIA", media_}}},
                   {"active_media_reference_key", "DEFAULT_MEDIA"}});
  }

  // The frames hold the mixture already.  Both clips refer to the same frames there, so that an
  // editor's own dissolve changes nothing.
  Json transition(double begin, double cut, double length) const {
    const int first = frame_at(show_, begin), middle = frame_at(show_, cut),
              end = frame_at(show_, begin + length);
    return schema("Transition.1", {{"name", "dissolve"},
                                   {"in_offset", time(middle - first)},
                                   {"out_offset", time(end - middle)},
                                   {"transition_type", "SMPTE_Dissolve"}});
  }

  Json markers() const {
    Json markers = Json::array();
    for (const Marker& marker : show_.markers)
      markers.push_back(schema("Marker.2", {{"name", marker.name},
                                            {"color", "GREEN"},
                                            {"marked_range", range(nearest(marker), 0)},
                                            {"comment", ""}}));
    return markers;
  }
  int nearest(const Marker& marker) const {
    return static_cast<int>(std::lround(marker.at_s * show_.frames_per_second));
  }

  const Show& show_;
  double rate_;
  int frames_;
  Json media_;
};

std::string time_code(const Show& show, int frame) {
  constexpr int kMinute = 60, kHour = 3600, kStart = 1;  // hours
  const int rate = static_cast<int>(std::ceil(show.frames_per_second - 1e-9));
  const int seconds = frame / rate;
  return fmt::format("{:02}:{:02}:{:02}:{:02}", kStart + seconds / kHour, seconds % kHour / kMinute,
                     seconds % kMinute, frame % rate);
}

// A name in one line, without the bar that ends a field of a marker.
std::string in_one_field(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < ' ' || c == '|'; }, ' ');
  return name;
}

// Text between the lines of a subtitle has no blank line, which would end it, and of WebVTT no
// character with a meaning of its own.
std::string cue_text(const std::string& text, SubtitleKind kind) {
  std::string cue;
  for (const char c : text) {
    if (c == '\n' && (cue.empty() || cue.back() == '\n')) continue;
    if (kind == SubtitleKind::kWebVtt && c == '&')
      cue += "&amp;";
    else if (kind == SubtitleKind::kWebVtt && c == '<')
      cue += "&lt;";
    else if (kind == SubtitleKind::kWebVtt && c == '>')
      cue += "&gt;";
    else
      cue += c;
  }
  while (!cue.empty() && cue.back() == '\n') cue.pop_back();
  return cue;
}

std::string cue_time(double seconds, char point) {
  constexpr long kThousand = 1000, kMinute = 60, kHour = 3600;
  const long thousandths = std::lround(seconds * kThousand), whole = thousandths / kThousand;
  return fmt::format("{:02}:{:02}:{:02}{}{:03}", whole / kHour, whole % kHour / kMinute,
                     whole % kMinute, point, thousandths % kThousand);
}

}  // namespace

std::string otio_text(const Show& show, const FrameFolder& folder) {
  return OtioWriter(show, folder).text();
}

std::string marker_list(const Show& show) {
  std::string list = fmt::format("TITLE: {}\nFCM: NON-DROP FRAME\n\n", in_one_field(show.title));
  int number = 0;
  for (const Marker& marker : show.markers) {
    const int frame = static_cast<int>(std::lround(marker.at_s * show.frames_per_second));
    const std::string begin = time_code(show, frame), end = time_code(show, frame + 1);
    list += fmt::format("{:03}  001      V     C        {} {} {} {}\n", ++number, begin, end, begin,
                        end);
    list += fmt::format(" |C:ResolveColorGreen |M:{} |D:1\n\n", in_one_field(marker.name));
  }
  return list;
}

std::string subtitles(const Show& show, SubtitleKind kind) {
  std::vector<const Title*> titles;
  const auto add = [&](const std::vector<Title>& some) {
    for (const Title& title : some)
      if (!title.text.empty()) titles.push_back(&title);
  };
  add(show.titles);
  for (const Segment& segment : show.timeline) add(segment.titles);
  std::ranges::stable_sort(titles, {}, &Title::begin_s);
  const bool vtt = kind == SubtitleKind::kWebVtt;
  std::string file = vtt ? "WEBVTT\n\n" : "";
  int number = 0;
  for (const Title* title : titles) {
    const char point = vtt ? '.' : ',';
    const FrameState first =
        frame_state(show, std::min(first_frame_of(show, *title), frame_count(show) - 1));
    file +=
        fmt::format("{}\n{} --> {}\n{}\n\n", ++number, cue_time(title->begin_s, point),
                    cue_time(title->end_s, point), cue_text(text_at(show, *title, first), kind));
  }
  return file;
}

}  // namespace domefall
