#include "pipeline/survey/render_time.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <future>

#include "pipeline/image/graded_file.h"
#include "pipeline/image/scratch_folder.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/survey/reduced_frame.h"

namespace domefall {
namespace {

// The width in pixels of the largest of the three sizes.  The others have a half and a quarter of
// it.  Where a frame of the smallest takes longer than kLong seconds, all are smaller.
constexpr int kLarge = 1024, kSmallest = 16;
constexpr double kLong = 0.1;
constexpr int kFrames = 3;  // measured at each size
constexpr double kWorth = 0.05;

using Widths = std::array<int, 3>;

Widths widths_below(int large) {
  return {std::max(kSmallest, large / 4), std::max(kSmallest, large / 2), large};
}

Widths measured_widths(const Show& show) {
  return widths_below(std::min(columns(show.projection), kLarge));
}

// Seconds a frame takes by the clock, and of all processors together.  Other programs hardly change
// the latter.
struct Cost {
  double wall = 0, processor = 0;
  double linear_bytes = 0, graded_bytes = 0;  // of its files
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Run {
 public:
  Run(const Show& show, Renderer& renderer, const Grader* grader)
      : show_(show), renderer_(renderer), grader_(grader) {}

  // The cost of a frame in a run in which one frame is written while the next is rendered.
  Cost per_frame(int width) const {
    using Clock = std::chrono::steady_clock;
    const int count = frame_count(show_);
    std::future<void> writing;
    Clock::time_point start;
    double processor = 0;
    Cost cost;
    // One frame more is made: the clocks run from the writing of the first one on.
    for (int k = 0; k <= kFrames; ++k) {
      const auto number = static_cast<long>(count - 1) * std::max(0, 2 * k - 1) / (2 * kFrames);
      auto frame = std::make_shared<RenderedFrame>();
      render_for_files(renderer_, show_,
                       reduced(frame_state(show_, static_cast<int>(number)), width), *frame);
      if (writing.valid()) {
        writing.get();
        add_sizes(cost);
      }
      if (k == 0) start = Clock::now(), processor = processor_seconds();
      if (k < kFrames) writing = std::async(std::launch::async, [this, frame] { write(*frame); });
    }
    cost.wall = std::chrono::duration<double>(Clock::now() - start).count() / kFrames;
    cost.processor = (processor_seconds() - processor) / kFrames;
    return cost;
  }

 private:
  std::filesystem::path linear() const { return folder_ / "linear.exr"; }
  std::filesystem::path graded() const { return folder_ / "graded"; }

  void add_sizes(Cost& cost) const {
    if (show_.output.linear)
      cost.linear_bytes += static_cast<double>(std::filesystem::file_size(linear())) / kFrames;
    if (grader_)
      cost.graded_bytes += static_cast<double>(std::filesystem::file_size(graded())) / kFrames;
  }

  void write(const RenderedFrame& frame) const {
    std::future<void> other;
    if (show_.output.linear)
      other = std::async(std::launch::async,
                         [&] { write_linear(linear(), show_, frame, FrameInfo{}); });
    if (grader_) {
      const auto rows = [&](int first, int end, unsigned short* rgb) {
        grader_->grade_rows(frame.half, first, end, rgb);
      };
      write_graded(graded(), {frame.half.width, frame.half.height, rows}, GradedInfo{},
                   *show_.output.graded);
    }
    if (other.valid()) other.get();
  }

  const Show& show_;
  Renderer& renderer_;
  const Grader* grader_;
  ScratchFolder folder_;
};

// A file's size at a width that is `doublings` doublings above `whole`'s.
double size_at(double half, double whole, double doublings) {
  const double growth = std::clamp(whole / std::max(half, 1.0), 2.0, 4.0);
  return whole * std::pow(growth, doublings);
}

}  // namespace

bool is_worth_measuring(const Show& show) {
  double measured = 0;  // frames of full size
  for (const int width : measured_widths(show))
    measured += (kFrames + 1) * std::pow(1.0 * width / columns(show.projection), 2);
  return measured < kWorth * frame_count(show);
}

RenderTime estimate_render_time(const Show& show, Renderer& renderer, const Grader* grader) {
  set_file_threads(renderer.threads());
  const Run run(show, renderer, grader);
  Widths widths = measured_widths(show);
  Cost quarter = run.per_frame(widths[0]);
  while (quarter.processor > kLong && widths[0] / 2 >= kSmallest) {
    widths = widths_below(widths[1]);
    quarter = run.per_frame(widths[0]);
  }
  const Cost half = run.per_frame(widths[1]), whole = run.per_frame(widths[2]);
  // A part of the work is proportional to the pixels, another to the length of edges, and another
  // to the stars.
  const double step = std::max(0.0, whole.processor - half.processor);
  const double growth =
      std::clamp(step / std::max(half.processor - quarter.processor, 1e-9), 2.0, 4.0);
  const double doublings = std::log2(1.0 * columns(show.projection) / widths[2]);
  const double more = step * growth * (std::pow(growth, doublings) - 1) / (growth - 1);
  RenderTime time;
  time.threads = renderer.threads();
  time.frame_s = whole.wall * (1 + more / std::max(whole.processor, 1e-9));
  time.linear_bytes = size_at(half.linear_bytes, whole.linear_bytes, doublings);
  time.graded_bytes = size_at(half.graded_bytes, whole.graded_bytes, doublings);
  time.seconds = time.frame_s * frame_count(show);
  return time;
}

}  // namespace domefall
