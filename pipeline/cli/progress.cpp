#include "pipeline/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/image/errors.h"

namespace domefall {

ProgressForm progress_form(const std::string& name) {
  if (name == "plain") return ProgressForm::kPlain;
  if (name == "json") return ProgressForm::kJson;
  if (name == "openjd") return ProgressForm::kOpenJd;
  if (name == "afanasy") return ProgressForm::kAfanasy;
  throw InputError("--progress " + name + ": there are plain, json, openjd and afanasy");
}

Progress::Progress(std::size_t total, std::optional<ProgressForm> form)
    : total_(total),
      form_(form),
      terminal_(!form && isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {
  draw();
}

Progress::~Progress() {
  if (terminal_) std::fputs("\n", stderr);
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

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::draw() const {
  if (!terminal_) return;
  constexpr std::size_t kWidth = 30;
  const std::size_t done = made_ + skipped_;
  const std::size_t filled = total_ > 0 ? kWidth * done / total_ : kWidth;
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  // Only frames that were made count for the rate, since skipping one takes next to no time.
  const double rate = static_cast<double>(made_) / seconds();
  std::fprintf(stderr, "\r[%s] %zu/%zu frames", bar.c_str(), done, total_);
  if (made_ > 0) {
    const auto left = std::lround(static_cast<double>(total_ - done) / rate);
    std::fprintf(stderr, "  %.2f frames/s  ETA %ld:%02ld:%02ld ", rate, left / 3600, left / 60 % 60,
                 left % 60);
  }
  std::fflush(stderr);
}

}  // namespace domefall
