#include "pipeline/cli/render_time.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>

#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/light_survey.h"

namespace domefall {
namespace {

// Pixels along the longer side of the larger of the two sizes; the smaller one has a quarter of it.
constexpr int kLarge = 1024, kSmaller = 4;
constexpr int kSmallFrames = 4, kLargeFrames = 3;

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("domefall_check_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

double pixels_of(const Projection& p) { return 1.0 * columns(p) * rows(p); }

FrameState resized_state(const Show& show, int frame, int width) {
  FrameState state = frame_state(show, frame);
  state.projection = shrunk(state.projection, width);
  if (state.vanishing) {
    auto vanishing = std::make_shared<FrameState>(*state.vanishing);
    vanishing->projection = shrunk(vanishing->projection, width);
    state.vanishing = vanishing;
  }
  return state;
}

class Run {
 public:
  Run(const Show& show, Renderer& renderer, const Grader* grader)
      : show_(show), renderer_(renderer), grader_(grader) {}

  // Seconds a frame, in a run in which one frame is written while the next is rendered.
  double seconds_per_frame(int frames, int width) const {
    const int count = frame_count(show_);
    std::future<void> writing;
    std::chrono::steady_clock::time_point start;
    // One more, from whose writing on the clock runs.
    for (int k = 0; k <= frames; ++k) {
      const auto number = static_cast<long>(count - 1) * std::max(0, 2 * k - 1) / (2 * frames);
      auto frame = std::make_shared<HalfFrame>(
          renderer_.render(resized_state(show_, static_cast<int>(number), width)));
      if (writing.valid()) writing.get();
      if (k == 0) start = std::chrono::steady_clock::now();
      if (k < frames) writing = std::async(std::launch::async, [this, frame] { write(*frame); });
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / frames;
  }

 private:
  void write(const HalfFrame& frame) const {
    std::future<void> linear = std::async(
        std::launch::async, [&] { write_frame(folder_.file("linear.exr"), frame, FrameInfo{}); });
    if (grader_)
      write_graded(
          folder_.file(show_.graded_format == GradedFormat::kTiff ? "graded.tif" : "graded.png"),
          grader_->grade(frame), GradedInfo{});
    linear.get();
  }

  const Show& show_;
  Renderer& renderer_;
  const Grader* grader_;
  TemporaryFolder folder_;
};

}  // namespace

RenderTime estimate_render_time(const Show& show, Renderer& renderer, const Grader* grader) {
  set_file_threads(renderer.threads());
  const Run run(show, renderer, grader);
  const int large = std::min(columns(show.projection), kLarge);
  const double small_s = run.seconds_per_frame(kSmallFrames, std::max(16, large / kSmaller));
  const double large_s = run.seconds_per_frame(kLargeFrames, large);
  const double small_pixels = pixels_of(shrunk(show.projection, std::max(16, large / kSmaller))),
               large_pixels = pixels_of(shrunk(show.projection, large));
  const double per_pixel = large_pixels > small_pixels
                               ? std::max(0.0, large_s - small_s) / (large_pixels - small_pixels)
                               : 0;
  RenderTime time;
  time.threads = renderer.threads();
  time.frame_s = large_s + per_pixel * (pixels_of(show.projection) - large_pixels);
  time.seconds = time.frame_s * frame_count(show);
  return time;
}

}  // namespace domefall
