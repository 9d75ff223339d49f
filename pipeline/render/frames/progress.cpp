#include "pipeline/render/frames/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"

namespace domefall {

ProgressForm progress_form(const std::string& name) {
  if (name == "plain") return ProgressForm::kPlain;
  if (name == "json") return ProgressForm::kJson;
  if (name == "openjd") return ProgressForm::kOpenJd;
  if (name == "afanasy") return ProgressForm::kAfanasy;
  throw InputError("--progress " + name + ": there are plain, json, openjd and afanasy");
}

Progress::Progress(std::size_t total, std::optional<ProgressForm> form)
    : total_(total), form_(form), terminal_(!form && isatty(STDERR_FILENO) != 0) {
  draw();
}

Progress::~Progress() { end(); }

void Progress::end() const {
  if (terminal_) end_bar();
}

void Progress::made(int frame) {
  ++made_;
  draw();
  print(frame, true);
}

void Progress::skipped(int frame) {
  ++skipped_;
  draw();
  print(frame, false);
}

void Progress::print(int frame, bool made) const {
  if (!form_) return;
  const std::size_t done = made_ + skipped_;
  const double percent = 100.0 * static_cast<double>(done) / static_cast<double>(total_);
  const std::string plain = fmt::format("frame {}: {} of {}", frame, done, total_);
  switch (*form_) {
    case ProgressForm::kPlain:
      fmt::print("{}\n", plain);
      break;
    case ProgressForm::kJson:
      fmt::print("{}\n", nlohmann::ordered_json{{"frame", frame},
                                                {"done", done},
                                                {"total", total_},
                                                {"made", made},
                                                {"seconds", std::round(seconds() * 1e3) / 1e3}}
                             .dump());
      break;
    case ProgressForm::kOpenJd:
      fmt::print("openjd_progress: {:.1f}\nopenjd_status: {}\n", percent, plain);
      break;
    case ProgressForm::kAfanasy:
      fmt::print("FRAME: {}\nPROGRESS: 100%\n", frame);
      break;
  }
  // A queue manager reads a pipe, and wants each line at once.
  std::fflush(stdout);
}

void Progress::draw() const {
  // The terminal is asked each time, since its window may have another width by now.  Its last
  // column stays free, since it may begin a new line behind it.
  if (terminal_) show_bar(bar(std::max<std::size_t>(terminal_columns(), 1) - 1));
}

// Returns as much of the bar as these columns hold.
std::string Progress::bar(std::size_t columns) const {
  constexpr std::size_t kWidest = 30, kNarrowest = 5, kAround = 3;  // brackets and a blank
  const std::size_t done = made_ + skipped_;
  const std::string least = fmt::format("{}/{}", done, total_), count = least + " frames";
  std::string eta, rate;
  if (made_ > 0) {
    // Only frames that were made count for the rate, since skipping one takes next to no time.
    const double per_second = static_cast<double>(made_) / seconds();
    const auto left = std::lround(static_cast<double>(total_ - done) / per_second);
    eta = fmt::format("  ETA {}:{:02}:{:02}", left / 3600, left / 60 % 60, left % 60);
    rate = fmt::format("  {:.2f} frames/s", per_second);
  }
  const std::string all = fmt::format("{}{}{}", count, rate, eta);
  for (const std::string& text : {all, count + eta, count, least}) {
    if (text.size() + kNarrowest + kAround > columns) continue;
    const std::size_t width = std::min(kWidest, columns - text.size() - kAround);
    const std::size_t filled = total_ > 0 ? width * done / total_ : width;
    return fmt::format("[{:#<{}}{:.<{}}] {}", "", filled, "", width - filled, text);
  }
  return least.size() <= columns ? least : std::string();
}

}  // namespace domefall
