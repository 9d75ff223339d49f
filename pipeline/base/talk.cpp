#include "pipeline/base/talk.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <mutex>
#include <string>

#include "pipeline/base/utf8.h"

namespace domefall {
namespace {

std::mutex talk_mutex;
std::string shown_bar;  // what stands in the terminal's last line
std::atomic<bool> is_shown{false};

// The last column stays free, since a terminal may begin a new line behind it.
std::size_t bar_room() { return std::max<std::size_t>(terminal_columns(), 1) - 1; }

// Returns blanks over as much of the bar as a line of `columns` leaves.  Blanks do on any terminal,
// also where no escape sequences are understood.
std::string blanks_behind(std::size_t columns) {
  const std::size_t old = std::min(shown_bar.size(), bar_room());
  return std::string(old > columns ? old - columns : 0, ' ');
}

void write_talk(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace

void say(std::string_view text) {
  std::string lines = printable_lines(text);
  if (!lines.ends_with('\n')) lines += '\n';
  const std::lock_guard lock(talk_mutex);
  if (shown_bar.empty()) return write_talk(lines);
  write_talk("\r" + blanks_behind(0) + "\r" + lines + shown_bar.substr(0, bar_room()));
}

std::size_t terminal_columns() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool told = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return told ? size.ws_col : kUsual;
}

void show_bar(std::string_view line) {
  const std::lock_guard lock(talk_mutex);
  write_talk("\r" + std::string(line) + blanks_behind(line.size()));
  shown_bar = line;
  is_shown = !line.empty();
}

void end_bar() {
  const std::lock_guard lock(talk_mutex);
  if (!shown_bar.empty()) write_talk("\n");
  shown_bar.clear();
  is_shown = false;
}

bool bar_is_shown() { return is_shown; }

std::string with_commas(std::size_t count) {
  std::string digits = fmt::to_string(count);
  // The commas go in from the right, so that the places of those to come do not move.
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", with_commas(count), what, count == 1 ? "" : "s");
}

}  // namespace domefall
