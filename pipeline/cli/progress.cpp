#include "pipeline/cli/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace domefall {

Progress::Progress(std::size_t total)
    : total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {
  draw();
}

Progress::~Progress() {
  if (terminal_) std::fputs("\n", stderr);
}

void Progress::made() {
  ++made_;
  draw();
}

void Progress::skipped() {
  ++skipped_;
  draw();
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
  // The rate is of frames that were made, since skipping one takes next to no time.
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
