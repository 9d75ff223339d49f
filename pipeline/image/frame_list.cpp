#include "pipeline/image/frame_list.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>
#include <set>
#include <string_view>

#include "pipeline/base/errors.h"

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

// Returns the index behind the frames from `first` on that are written as one range.  Frames that
// do not follow one another need four for it, since three are no longer by themselves.
std::size_t end_of_run(const std::vector<int>& frames, std::size_t first) {
  std::size_t end = first + 1;
  if (end == frames.size()) return end;
  const int step = frames[end] - frames[first];
  while (end < frames.size() && frames[end] - frames[end - 1] == step) ++end;
  constexpr std::size_t kFewest = 4;
  return step == 1 || end - first >= kFewest ? end : first + 1;
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

std::string as_ranges(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t first = 0, next = 0; first < frames.size(); first = next) {
    next = end_of_run(frames, first);
    const int step = next > first + 1 ? frames[first + 1] - frames[first] : 1;
    if (!text.empty()) text += ',';
    text += fmt::to_string(frames[first]);
    if (next > first + 1) text += fmt::format("-{}", frames[next - 1]);
    if (step > 1) text += fmt::format("x{}", step);
  }
  return text;
}

}  // namespace domefall
