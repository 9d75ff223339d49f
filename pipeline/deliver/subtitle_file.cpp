#include "pipeline/deliver/subtitle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {
namespace {

constexpr std::string_view kArrow = "-->";

// Takes a number from the front of a text.  It has exactly `digits` digits or, where there may be
// `more`, as in the hours, from that many to four.
std::optional<int> take_digits(std::string_view& text, std::size_t digits, bool more) {
  std::size_t count = 0;
  while (count < text.size() && text[count] >= '0' && text[count] <= '9') ++count;
  constexpr std::size_t kMost = 4;
  if (count < digits || count > (more ? kMost : digits)) return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + count, value);
  text.remove_prefix(count);
  return value;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

// Returns the seconds of a time such as 00:00:01,000.  Some programs write a point for the comma.
std::optional<double> srt_time(std::string_view text) {
  const auto take = [&text](std::string_view marks) {
    const bool there = !text.empty() && marks.find(text[0]) != std::string_view::npos;
    if (there) text.remove_prefix(1);
    return there;
  };
  const auto hours = take_digits(text, 1, true);
  if (!hours || !take(":")) return std::nullopt;
  const auto minutes = take_digits(text, 2, false);
  if (!minutes || !take(":")) return std::nullopt;
  const auto seconds = take_digits(text, 2, false);
  if (!seconds || !take(",.")) return std::nullopt;
  const auto thousandths = take_digits(text, 3, false);
  if (!thousandths || !text.empty() || *minutes > 59 || *seconds > 59) return std::nullopt;
  return *hours * 3600.0 + *minutes * 60.0 + *seconds + *thousandths / 1000.0;
}

}  // namespace

SubtitleFile parse_subtitles(std::string_view text) {
  SubtitleFile found;
  for (int line_number = 1; !text.empty(); ++line_number) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const auto arrow = line.find(kArrow);
    if (arrow == std::string_view::npos) continue;
    const std::string_view behind = without_blanks(line.substr(arrow + kArrow.size()));
    const auto from = srt_time(without_blanks(line.substr(0, arrow)));
    // Coordinates on the screen may follow the time.
    const auto to = srt_time(behind.substr(0, behind.find_first_of(" \t")));
    if (!from || !to)
      throw InputError(fmt::format("line {}: expected times such as 00:00:01,000 --> 00:00:04,000",
                                   line_number));
    if (*to <= *from)
      throw InputError(fmt::format("line {}: the subtitle ends before it begins", line_number));
    ++found.count;
    found.end_s = std::max(found.end_s, *to);
  }
  if (found.count == 0)
    throw InputError("no subtitle is in it; the times of SubRip (.srt) are read");
  return found;
}

SubtitleFile read_subtitle_file(const std::filesystem::path& path) {
  constexpr std::uint64_t kMost = std::uint64_t{16} << 20;
  const std::string text = read_file(require_file(path), kMost);
  try {
    return parse_subtitles(text);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace domefall
