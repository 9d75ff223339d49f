#include "pipeline/image/frame_list.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>
#include <set>
#include <string_view>

#include "pipeline/image/errors.h"

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

std::string as_ranges(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < frames.size(); first = ++last) {
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
    if (!text.empty()) text += ',';
    text += fmt::to_string(frames[first]);
    if (last > first) text += fmt::format("-{}", frames[last]);
  }
  return text;
}

}  // namespace domefall
