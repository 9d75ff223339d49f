#include "pipeline/report/frame_timing.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "pipeline/base/stop_watch.h"

namespace domefall {
namespace {

constexpr double kWhite = 65535;  // in graded frames

}  // namespace

TimedFrame time_frame(Renderer& renderer, const FrameState& state, Repeats repeats) {
  TimedFrame best{{}, std::numeric_limits<double>::infinity()};
  double spent = 0;
  for (int k = 0; k < repeats.most && (k < 2 || spent < repeats.enough_s); ++k) {
    const double start = processor_seconds();
    renderer.render(state, best.frame);
    const double took = processor_seconds() - start;
    best.seconds = std::min(best.seconds, took);
    spent += k == 0 ? 0 : took;
  }
  return best;
}

TimedFrame time_frame(const Show& show, AntiAliasing anti_aliasing, int threads, Repeats repeats) {
  Renderer renderer(show, threads, anti_aliasing);
  return time_frame(renderer, frame_state(show, 0), repeats);
}

double copy_seconds(const HalfFrame& frame) {
  // One copy of a small frame is shorter than a tick of the clock, but 64 copies of a large one
  // would take seconds.  So a series copies as many frames as make up a fixed number of bytes.
  // The series of 2^28 bytes is two copies of a 4k frame (101 MB) or 42 of a frame of 1024 pixels.
  constexpr std::size_t kRows = 7, kMostCopies = 64, kBytesOfRow = std::size_t{1} << 28;
  const std::size_t bytes = frame.pixels.size() * sizeof(Imath::half);
  const std::size_t copies = std::clamp<std::size_t>(kBytesOfRow / bytes, 1, kMostCopies);
  HalfFrame copy(frame.width, frame.height);
  [[maybe_unused]] volatile float seen =
      0;  // reading a value keeps the copy from being optimised away
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < kRows; ++row) {
    const double start = processor_seconds();
    for (std::size_t k = 0; k < copies; ++k) {
      std::memcpy(copy.pixels.data(), frame.pixels.data(), bytes);
      seen = copy.pixels[k * 997 % copy.pixels.size()];
    }
    best = std::min(best, (processor_seconds() - start) / static_cast<double>(copies));
  }
  return best;
}

FrameDifference difference(const GradedFrame& a, const GradedFrame& b,
                           const Projection& projection) {
  double squares = 0, worst = 0, values = 0;
  for (int row = 0; row < a.height; ++row) {
    const ColumnRange inside = inside_columns(projection, row);
    for (int k = 3 * inside.first; k < 3 * (inside.last + 1); ++k, ++values) {
      // The values are 16-bit numbers, which become ints before they are subtracted.
      const double d = std::abs(a.row(row)[k] - b.row(row)[k]) / kWhite;
      squares += d * d, worst = std::max(worst, d);
    }
  }
  return {std::sqrt(squares / values), worst};
}

}  // namespace domefall
