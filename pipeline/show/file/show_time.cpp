#include "pipeline/show/file/show_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "pipeline/base/errors.h"
#include "pipeline/base/frame_rate.h"
#include "pipeline/base/utf8.h"
#include "pipeline/show/file/otio_markers.h"
#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

// A show is at most 10,000,000 seconds long.  This is the length of kMostFrames at the lowest frame
// rate, 1 a second.
constexpr std::string_view kPeriastron = "periastron";
constexpr Range kShowTime = Range{"seconds"}.within(0, 1e7);

bool is_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<double> parse_decimal(std::string_view text) {
  const std::string_view whole = text.substr(0, text.find('.'));
  const std::string_view rest = text.substr(whole.size());
  if (!is_digits(whole) || (!rest.empty() && !is_digits(rest.substr(1)))) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

const Marker* find_marker(std::string_view name, const std::vector<Marker>& markers) {
  const auto found = std::ranges::find(markers, name, &Marker::name);
  return found == markers.end() ? nullptr : &*found;
}

// Returns a marker's time in seconds since `start`, or reports one out of range.
std::optional<double> read_marked(const Item& item, const Marker& marker, const Range& range,
                                  double start) {
  // The range counts from `start`, and the message counts from the beginning of the show, as the
  // marker itself does.
  const double seconds = marker.at_s - start;
  // The bounds are those of broken_bound() in item.cpp, in words that suit times.
  const bool early = range.low_excluded ? !(seconds > range.low) : !(seconds >= range.low);
  const bool late = range.high_excluded ? !(seconds < range.high) : !(seconds <= range.high);
  if (!early && !late) return seconds;
  const char* bound = early ? (range.low_excluded ? "after" : "at least")
                            : (range.high_excluded ? "before" : "at most");
  return item.fail(fmt::format(
      "names the marker '{}', which lies at {} s, where it must be {} {} s", shown(marker.name),
      short_number(marker.at_s), bound, short_number(start + (early ? range.low : range.high))));
}

std::optional<double> read_rate_fraction(const Item& item, const Range& range) {
  constexpr std::int64_t kMost = 1'001'000;  // what programs for video count with
  const auto text = read_text(item);
  if (!text) return std::nullopt;
  const FrameRate rate = parse_frame_rate(*text);
  if (rate.seconds > 0 && std::max(rate.frames, rate.seconds) <= kMost)
    return in_range(item, per_second(rate), range);
  return item.fail(fmt::format(
      "must be a number, or a fraction of two whole numbers up to {} such as 24000/1001, got {}",
      kMost, kind_of(item)));
}

}  // namespace

void read_frame_rate(const Section& section, Show& show) {
  const Item* item = section.find("frames_per_second");
  if (!item) return;
  const bool is_fraction =
      item->node.IsScalar() && item->node.Scalar().find('/') != std::string::npos;
  const Range range = section.range("frames_per_second");
  const auto written = is_fraction ? read_rate_fraction(*item, range) : read_number(*item, range);
  if (!written) return;
  constexpr double kSame = 1e-10;
  const double meant = per_second(frame_rate_of(*written));
  const bool differs = std::abs(*written / meant - 1) > kSame;
  show.frames_per_second = differs ? meant : *written;
  if (differs) show.written_rate = *written;
}

std::optional<double> parse_clock_time(std::string_view text) {
  constexpr double kSixty = 60;
  double seconds = 0;
  int parts = 0;
  for (std::size_t colon = 0; colon != std::string_view::npos && parts < 3; ++parts) {
    colon = text.find(':');
    const std::string_view part = text.substr(0, colon);
    const bool last = colon == std::string_view::npos;
    const auto value = parse_decimal(part);
    if (!value || (!last && !is_digits(part))) return std::nullopt;
    // Minutes and seconds behind a colon have two digits and stay below 60.  A part without a point
    // is found at npos, which is no less than 2.
    if (parts > 0 && (part.find('.') < 2 || part.size() < 2 || *value >= kSixty))
      return std::nullopt;
    seconds = seconds * kSixty + *value;
    if (!last) text.remove_prefix(colon + 1);
    if (last) return parts > 0 ? std::optional(seconds) : std::nullopt;
  }
  return std::nullopt;
}

std::string clock_text(double seconds) {
  constexpr long kThousand = 1000, kMinute = 60 * kThousand;
  // Rounding comes first, so that 59.9996 s are 1:00 and not 0:60.
  const long thousandths = std::lround(seconds * kThousand);
  const long minutes = thousandths / kMinute, rest = thousandths % kMinute;
  std::string text = fmt::format("{}:{:02}.{:03}", minutes, rest / kThousand, rest % kThousand);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::optional<double> parse_time(std::string_view text, const std::vector<Marker>& markers) {
  if (const auto clock = parse_clock_time(text)) return clock;
  if (const auto number = parse_decimal(text)) return number;
  if (const Marker* marker = find_marker(text, markers)) return marker->at_s;
  return std::nullopt;
}

namespace {

// A name that is a time itself could not be told from one.
bool can_name_a_marker(const std::string& name) { return !parse_time(name, {}); }

MarkerEvent read_passage(const Item& item) {
  const Section s(item, {"marker"});
  const auto leg = s.given_word("leg", {Leg::kInward, Leg::kOutward});
  const Item* place = s.one_of({"r", "l"});
  if (place && place == s.find("l")) return {{}, leg, s.given("l")};
  return {s.required("r"), leg};
}

std::vector<Marker> markers_of_file(const Item& item, const Lookup& lookup) {
  const auto file = lookup.file(item, item.node.Scalar());
  if (!file) return {};
  try {
    std::vector<Marker> markers = read_otio_markers(*file);
    for (Marker& marker : markers)
      if (!can_name_a_marker(marker.name)) marker.name = "marker " + marker.name;
    return markers;
  } catch (const InputError& error) {
    item.fail(error.what());
    return {};
  }
}

}  // namespace

std::vector<Marker> read_markers(const Section& show, const Lookup& lookup) {
  std::vector<Marker> markers;
  const Item* list = show.find("markers");
  if (!list) return markers;
  if (list->node.IsScalar() && list->node.Scalar().ends_with(".otio"))
    return markers_of_file(*list, lookup);
  if (!list->node.IsMap()) {
    list->fail(
        "must be a map of names and times, e.g. {door_opens: 0:34}, or a file such as cut.otio, "
        "got " +
        kind_of(*list));
    return markers;
  }
  for (const auto& [name, item] : entries_of(*list)) {
    if (!can_name_a_marker(name))
      item.fail("has a name that is a time itself; begin it with a letter");
    else if (item.node.IsMap())
      markers.push_back({name, std::nan(""), read_passage(item)});
    else if (item.node.IsScalar() && item.node.Scalar() == kPeriastron)
      markers.push_back({name, std::nan(""), MarkerEvent{}});
    else if (const auto at = read_time(item, kShowTime))
      markers.push_back({name, *at});
  }
  return markers;
}

std::optional<double> read_time(const Item& item, const Range& range,
                                const std::vector<Marker>& markers, double start) {
  if (item.node.IsScalar()) {
    // The name of no marker has the form of a time (read_markers), so a clock time may come first.
    const std::string& text = item.node.Scalar();
    if (const auto clock = parse_clock_time(text)) return in_range(item, *clock, range);
    if (const Marker* marker = find_marker(text, markers)) {
      // An event without a time, or the timeline that lacks it, has been reported.
      return std::isnan(marker->at_s) ? std::nullopt : read_marked(item, *marker, range, start);
    }
    if (text.find(':') != std::string::npos) {
      const std::string odd = odd_character(text);
      return item.fail("must be seconds, or minutes and seconds such as 1:02.5, got '" +
                       shown(text) + "'" + (odd.empty() ? "" : ", which " + odd));
    }
    // A text that does not begin as a number does can only be the name of a marker.
    const bool word = !text.empty() && text.find_first_of("0123456789+-.") != 0;
    if (word && !markers.empty()) {
      std::vector<std::string_view> names;
      names.reserve(markers.size());
      for (const Marker& marker : markers) names.push_back(marker.name);
      return item.fail("names a marker that the show does not have: '" + shown(text) + "'" +
                       did_you_mean(text, names));
    }
  }
  return read_number(item, range);
}

}  // namespace domefall
