#include "pipeline/theatre/delivery/subtitle_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

constexpr std::string_view kArrow = "-->";

std::optional<int> take_digits(std::string_view& text, std::size_t least, std::size_t most) {
  std::size_t count = 0;
  while (count < text.size() && text[count] >= '0' && text[count] <= '9') ++count;
  if (count < least || count > most) return std::nullopt;
  int value = 0;
  std::from_chars(text.data(), text.data() + count, value);
  text.remove_prefix(count);
  return value;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

// Takes the mark and the digits of a fraction, and returns its thousandths.  Programs write a comma
// or a point, one to three digits, or no fraction at all.
std::optional<int> take_fraction(std::string_view& text) {
  constexpr std::array kThousandths{0, 100, 10, 1};
  if (text.empty()) return 0;
  if (text[0] != ',' && text[0] != '.') return std::nullopt;
  text.remove_prefix(1);
  const std::size_t before = text.size();
  const auto digits = take_digits(text, 1, 3);
  if (!digits) return std::nullopt;
  return *digits * kThousandths[before - text.size()];
}

// Returns the seconds of a time such as 00:00:01,000, or 00:01.000 without hours as in WebVTT.
std::optional<double> subtitle_time(std::string_view text) {
  std::array<int, 3> parts{};  // hours, minutes, seconds
  const auto colons = static_cast<std::size_t>(std::ranges::count(text, ':'));
  if (colons < 1 || colons > 2) return std::nullopt;
  for (std::size_t k = 2 - colons; k < parts.size(); ++k) {
    const bool hours = k == 0;
    const auto digits = take_digits(text, hours ? 1 : 2, hours ? 4 : 2);
    if (!digits || (!hours && *digits > 59)) return std::nullopt;
    parts[k] = *digits;
    if (k == 2) break;
    if (!text.starts_with(':')) return std::nullopt;
    text.remove_prefix(1);
  }
  const auto thousandths = take_fraction(text);
  if (!thousandths || !text.empty()) return std::nullopt;
  return parts[0] * 3600.0 + parts[1] * 60.0 + parts[2] + *thousandths / 1000.0;
}

struct SubtitleTimes {
  double from_s, to_s;
};

std::optional<SubtitleTimes> subtitle_times(std::string_view line) {
  const auto arrow = line.find(kArrow);
  if (arrow == std::string_view::npos) return std::nullopt;
  const std::string_view behind = without_blanks(line.substr(arrow + kArrow.size()));
  const auto from = subtitle_time(without_blanks(line.substr(0, arrow)));
  // Coordinates on the screen may follow the time.
  const auto to = subtitle_time(behind.substr(0, behind.find_first_of(" \t")));
  if (!from || !to) return std::nullopt;
  return SubtitleTimes{*from, *to};
}

bool is_index(std::string_view line) {
  return !line.empty() && line.find_first_not_of("0123456789") == std::string_view::npos;
}

bool begins_with_time(std::string_view line) {
  const std::size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
  return line.substr(digits).starts_with(':');
}

// A SubtitleReader goes through the lines, and gathers what is odd about their times.
class SubtitleReader {
 public:
  void take(std::string_view line) {
    ++line_number_;
    line = without_blanks(line);
    if (const auto times = subtitle_times(line)) {
      keep(*times);
      place_ = Place::kText;
    } else if (is_wrong_time(line)) {
      fail("expected times such as 00:00:01,000 --> 00:00:04,000");
    } else if (line.empty()) {
      place_ = Place::kStart;
    } else if (place_ == Place::kStart) {
      place_ = is_index(line) ? Place::kTimes : Place::kText;
    }
  }

  SubtitleFile finished() {
    if (found_.count == 0)
      throw InputError("no subtitle is in it; the times of SubRip (.srt) are read");
    note(backward_, "before the one before it does");
    note(overlapping_, "before the one before it ends");
    return std::move(found_);
  }

 private:
  // Where a line may stand: behind an empty line, behind the number of a subtitle, or in its text.
  enum class Place { kStart, kTimes, kText };
  struct Oddities {
    int count = 0, first_line = 0;
    void add(int line) {
      if (count++ == 0) first_line = line;
    }
  };

  // A line of text may have an arrow in it.
  bool is_wrong_time(std::string_view line) const {
    const bool arrow = line.find(kArrow) != std::string_view::npos, time = begins_with_time(line);
    return place_ == Place::kTimes ? arrow || time : place_ == Place::kStart && arrow && time;
  }

  void keep(const SubtitleTimes& times) {
    if (times.to_s <= times.from_s) fail("the subtitle ends before it begins");
    if (found_.count > 0 && times.from_s < last_.from_s)
      backward_.add(line_number_);
    else if (found_.count > 0 && times.from_s < last_.to_s)
      overlapping_.add(line_number_);
    last_ = times;
    ++found_.count;
    found_.end_s = std::max(found_.end_s, times.to_s);
  }

  void note(const Oddities& oddities, const char* what) {
    if (oddities.count == 1)
      found_.notes.push_back(
          fmt::format("line {}: the subtitle begins {}", oddities.first_line, what));
    if (oddities.count > 1)
      found_.notes.push_back(fmt::format("line {}: the subtitle begins {}, and so do {} more",
                                         oddities.first_line, what, oddities.count - 1));
  }

  [[noreturn]] void fail(const char* what) const {
    throw InputError(fmt::format("line {}: {}", line_number_, what));
  }

  SubtitleFile found_;
  SubtitleTimes last_{};
  Place place_ = Place::kStart;
  Oddities backward_, overlapping_;
  int line_number_ = 0;
};

// Throws InputError for the first byte that is no UTF-8.
void check_utf8(std::string_view text) {
  int line = 1;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0)
      throw InputError(fmt::format(
          "line {}: the byte 0x{:02X} is not UTF-8; the text may be Windows-1252 or Latin-1, which "
          "players show wrong: save it as UTF-8",
          line, static_cast<unsigned char>(text.front())));
    if (text.front() == '\0')
      throw InputError(fmt::format("line {}: a byte of 0 has no place in subtitles", line));
    if (text.front() == '\n' || (text.front() == '\r' && !text.starts_with("\r\n"))) ++line;
    text.remove_prefix(length);
  }
}

}  // namespace

SubtitleFile parse_subtitles(std::string_view text) {
  text = without_byte_order_mark(text);
  check_utf8(text);
  SubtitleReader reader;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    reader.take(text.substr(0, end));
    text.remove_prefix(end);
    text.remove_prefix(std::min<std::size_t>(text.size(), text.starts_with("\r\n") ? 2 : 1));
  }
  return reader.finished();
}

SubtitleFile read_subtitle_file(const std::filesystem::path& path) {
  constexpr std::uint64_t kMost = std::uint64_t{16} << 20;
  std::string bytes = read_file(require_file(path), kMost);
  const bool converted = text_encoding(bytes) != TextEncoding::kUtf8;
  std::string text = as_utf8(std::move(bytes), path);
  try {
    SubtitleFile found = parse_subtitles(text);
    const bool is_web = text.starts_with("WEBVTT"),
               is_named_so = in_lower_case(path.extension().string()) == ".vtt";
    if (is_web != is_named_so)
      found.notes.push_back(fmt::format("the text is {}, whose files are called {}",
                                        is_web ? "WebVTT" : "SubRip", is_web ? ".vtt" : ".srt"));
    if (converted) {
      found.notes.insert(found.notes.begin(), "the text is UTF-16, and is delivered as UTF-8");
      found.converted = std::move(text);
    }
    return found;
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace domefall
