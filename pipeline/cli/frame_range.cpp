#include "pipeline/cli/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>

#include "pipeline/cli/number_in.h"
#include "pipeline/image/errors.h"
#include "pipeline/show/nearest_word.h"
#include "pipeline/show/show_time.h"

namespace domefall {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& what) {
  throw InputError("--frames " + text + ": " + what);
}

// Removes a whole number from the front of `rest` and returns it.
int take_number(std::string_view& rest, const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc() || value < 0) fail(text, "expected frames such as 7, 0-299 or 0-599x10");
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return value;
}

// Removes a character from the front of `rest`, and returns whether it was there.
bool take(std::string_view& rest, char c) {
  if (rest.empty() || rest[0] != c) return false;
  rest.remove_prefix(1);
  return true;
}

}  // namespace

std::vector<int> parse_frames(const std::string& text, int count) {
  if (text.empty()) {
    std::vector<int> all(static_cast<std::size_t>(count));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  std::set<int> frames;
  std::string_view rest = text;
  do {
    const int first = take_number(rest, text);
    const int last = take(rest, '-') ? take_number(rest, text) : first;
    const int step = take(rest, 'x') ? take_number(rest, text) : 1;
    if (last < first) fail(text, "the range ends before it begins");
    if (step < 1) fail(text, "the step must be at least 1");
    if (last >= count)
      fail(text, fmt::format("the show has {} frames, the last is {}", count, count - 1));
    for (long k = first; k <= last; k += step) frames.insert(static_cast<int>(k));
  } while (take(rest, ','));
  if (!rest.empty()) fail(text, "expected frames such as 7, 0-299 or 0-599x10");
  return {frames.begin(), frames.end()};
}

void add_frame_choice(CLI::App& verb, FrameChoice& choice) {
  auto* frame = verb.add_option("--frame", choice.frame, "frame number, from 0")
                    ->check(number_in(0, kMostFrames - 1));
  verb.add_option("--at", choice.at, "instead: a time of the show, 34.5, 0:34.5 or a marker")
      ->type_name("TIME")
      ->excludes(frame);
}

int chosen_frame(const FrameChoice& choice, const Show& show) {
  if (choice.at.empty())
    return parse_frames(fmt::to_string(choice.frame), frame_count(show)).front();
  const auto seconds = parse_time(choice.at, show.markers);
  const double end = end_of(show);
  if (!seconds) {
    std::vector<std::string_view> names;
    for (const Marker& marker : show.markers) names.push_back(marker.name);
    throw InputError("--at " + choice.at + ": expected seconds, a time such as 1:02.5" +
                     (names.empty() ? "" : " or a marker (" + listed(names) + ")"));
  }
  if (*seconds > end)
    throw InputError(fmt::format("--at {}: the show ends at {} s ({})", choice.at,
                                 short_number(end), clock_text(end)));
  return nearest_frame(show, *seconds);
}

}  // namespace domefall
