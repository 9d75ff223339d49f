#include "pipeline/show/title_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/show/nearest_word.h"

namespace domefall {
namespace {

enum class Counter { kRadius, kTime, kProperTime, kYear, kSpeed };

constexpr std::array<std::string_view, 5> kCounterNames{"r", "time", "proper_time", "year",
                                                        "speed"};

std::optional<Counter> counter_named(std::string_view name) {
  const auto* const found = std::ranges::find(kCounterNames, name);
  if (found == kCounterNames.end()) return std::nullopt;
  return static_cast<Counter>(found - kCounterNames.begin());
}

// A Piece of a text is words, one brace that was doubled, or what stands between two braces.
// Without its second brace it is `open`.
struct Piece {
  std::string_view words;
  bool braced = false, open = false;
};

// Takes the first piece off a text that is not empty.
Piece take_piece(std::string_view& text) {
  const auto take = [&text](std::size_t length) {
    const std::string_view taken = text.substr(0, length);
    text.remove_prefix(taken.size());
    return taken;
  };
  const std::size_t brace = text.find_first_of("{}");
  if (brace != 0) return {take(brace)};
  if (text.starts_with("{{") || text.starts_with("}}")) return {take(2).substr(1)};
  if (text.front() == '}') return {take(1), false, true};
  const std::size_t end = text.find_first_of("{}", 1);
  if (end == std::string_view::npos || text[end] == '{') return {take(end), true, true};
  const std::string_view braced = take(end + 1);
  return {braced.substr(1, braced.size() - 2), true};
}

// ---- numbers ----

// Parts of a step that are taken as a whole one.
constexpr double kNudge = 1e-6;

double step_of(int decimals) { return std::pow(10.0, -decimals); }
double rounded(double value, int decimals) {
  return std::floor(value / step_of(decimals) + 0.5 + kNudge) * step_of(decimals);
}
double cut_off(double value, int decimals) {
  return std::floor(value / step_of(decimals) + kNudge) * step_of(decimals);
}

// The minus of typography is as wide as the plus, and nearly as a digit.
std::string fixed(double value, int decimals) {
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  return (value < 0 ? "\u2212" : "") + digits;
}

// Returns how many decimals give a number of this size three digits.
int decimals_for(double size) { return size < 10 ? 2 : size < 100 ? 1 : 0; }

// Writes seconds, which must be at least 0, as H:MM:SS, or without the hours as M:SS.
std::string clock_of(double seconds, bool hours) {
  constexpr long kMinute = 60, kHour = 3600;
  const auto whole = static_cast<long>(std::floor(seconds + kNudge));
  if (hours)
    return fmt::format("{}:{:02}:{:02}", whole / kHour, whole % kHour / kMinute, whole % kMinute);
  return fmt::format("{}:{:02}", whole / kMinute, whole % kMinute);
}

// ---- counters ----

// These are the values of a counter in the first and the last frame of a title.
struct Ends {
  double first, last;
  double largest() const { return std::max(std::abs(first), std::abs(last)); }
  double least() const { return std::min(std::abs(first), std::abs(last)); }
};

constexpr double kJulianYear = 31557600;  // seconds

// Returns the value of a counter, in the unit of its text or, for times, in seconds.  There is no
// speed where nobody is at rest.
std::optional<double> value_of(Counter counter, const Show& show, const FrameState& state) {
  const ObserverState& o = dominant_view(state).observer;
  const double second_of_m = o.spacetime.seconds_per_m();
  switch (counter) {
    case Counter::kRadius:
      return o.r;
    case Counter::kTime:
      return state.show_time_s;
    case Counter::kProperTime:
      return o.proper_time * second_of_m;
    case Counter::kYear:
      return show.begins_year.value_or(0) + o.null_time * second_of_m / kJulianYear;
    case Counter::kSpeed:
      if (!has_rest(o)) return std::nullopt;
      return speed_of(static_celerity(o).length());
  }
  std::abort();
}

// Writes an observer's time: as a clock from a minute to four days, and with a unit else.
std::string proper_time_text(double seconds, const Ends& ends) {
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
  const double largest = ends.largest();
  if (largest >= kMinute && largest < 4 * kDay) {
    const bool signs = ends.first < 0 || ends.last < 0;
    return (seconds < 0 ? "\u2212"
            : signs     ? "+"
                        : "") +
           clock_of(std::abs(seconds), largest >= kHour);
  }
  constexpr std::array<std::pair<double, const char*>, 5> kUnits{
      {{kJulianYear, "a"}, {kDay, "d"}, {1, "s"}, {1e-3, "ms"}, {1e-6, "\u00b5s"}}};
  const auto* unit = std::ranges::find_if(
      kUnits, [&](const auto& known) { return largest >= known.first * (1 + kNudge); });
  if (unit == kUnits.end()) --unit;
  const int decimals = decimals_for(largest / unit->first);
  return fmt::format("{} {}", fixed(rounded(seconds / unit->first, decimals), decimals),
                     unit->second);
}

// Speeds are cut off, so that none below that of light is shown as 1, and so are dates.
std::string number_text(Counter counter, double value, const Ends& ends, double show_s) {
  constexpr double kHour = 3600;
  switch (counter) {
    case Counter::kRadius:
      return fixed(rounded(value, decimals_for(ends.least())), decimals_for(ends.least()));
    case Counter::kTime:
      return clock_of(value, show_s > kHour);
    case Counter::kProperTime:
      return proper_time_text(value, ends);
    case Counter::kYear: {
      const double span = std::abs(ends.last - ends.first);
      const int decimals = span < 0.5 ? 2 : span < 20 ? 1 : 0;
      return fixed(cut_off(value, decimals), decimals);
    }
    case Counter::kSpeed:
      return fixed(std::min(cut_off(value, 2), 0.99), 2);
  }
  std::abort();
}

std::size_t characters_in(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

int frame_from(const Show& show, double seconds) {
  return static_cast<int>(std::ceil(seconds * show.frames_per_second - kNudge));
}

std::string counter_text(Counter counter, const Show& show, const Title& title,
                         const FrameState& state) {
  const int last = std::clamp(frame_from(show, title.end_s) - 1, 0, frame_count(show) - 1);
  const FrameState from = frame_state(show, std::min(first_frame_of(show, title), last)),
                   to = frame_state(show, last);
  const auto now = value_of(counter, show, state), first = value_of(counter, show, from),
             end = value_of(counter, show, to);
  // A figure dash is as wide as a digit.
  if (!now) return "\u2012.\u2012\u2012";
  const Ends ends{first.value_or(*now), end.value_or(*now)};
  const auto written = [&](double value) {
    return number_text(counter, value, ends, end_of(show));
  };
  std::string text = written(*now);
  // A figure space is as wide as a digit, too.
  const std::size_t width =
      std::max(characters_in(written(ends.first)), characters_in(written(ends.last)));
  for (std::size_t k = characters_in(text); k < width; ++k) text.insert(0, "\u2007");
  return text;
}

}  // namespace

bool has_counters(std::string_view text) {
  while (!text.empty())
    if (take_piece(text).braced) return true;
  return false;
}

std::string counter_mistake(std::string_view text, const Show& show) {
  while (!text.empty()) {
    const Piece piece = take_piece(text);
    if (piece.open)
      return fmt::format("has a {} without its {}; a brace that is meant is doubled: {{{{ or }}}}",
                         piece.braced ? '{' : '}', piece.braced ? '}' : '{');
    if (!piece.braced) continue;
    const auto counter = counter_named(piece.words);
    if (!counter)
      return "has an unknown counter {" + shown(piece.words) + "}; counters are " +
             listed(kCounterNames) + did_you_mean(piece.words, kCounterNames);
    if (counter == Counter::kYear && !show.begins_year)
      return "has {year}, which needs the show's begins_year";
    if ((counter == Counter::kYear || counter == Counter::kRadius) && show.spacetime.is_flat())
      return fmt::format(
          "has {{{}}}, which needs a black hole: give the show "
          "black_hole.mass_solar",
          piece.words);
  }
  return {};
}

int first_frame_of(const Show& show, const Title& title) {
  return std::max(frame_from(show, title.begin_s), 0);
}

std::string text_at(const Show& show, const Title& title, const FrameState& state) {
  std::string text;
  for (std::string_view left = title.text; !left.empty();) {
    const Piece piece = take_piece(left);
    const auto counter = piece.braced ? counter_named(piece.words) : std::nullopt;
    text += counter ? counter_text(*counter, show, title, state) : std::string(piece.words);
  }
  return text;
}

}  // namespace domefall
