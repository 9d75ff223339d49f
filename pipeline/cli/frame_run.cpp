#include "pipeline/cli/frame_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <future>
#include <optional>
#include <stdexcept>
#include <thread>

#include "pipeline/cli/interruption.h"
#include "pipeline/cli/progress.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/image/temporary_file.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/renderer.h"

namespace domefall {
namespace {

// Frames of more pixels are made one at a time.
constexpr std::int64_t kMostPixelsOfTwo = 40'000'000;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A run with what it makes once: the grader, the keys, the renderer.
class Run {
 public:
  explicit Run(const FrameRun& run)
      : run_(run),
        grader_(grader_of(run.show)),
        keys_(run.show, grader_ ? grader_->transform_id() : std::string()) {
    name_ = run.show.file.stem().string();
    set_file_threads(file_threads());
    catch_interruptions();
    make_folder(run.folder / "linear");
    if (grades()) make_folder(run.folder / "graded");
  }

  void all() {
    Progress progress(run_.frames.size());
    // While one frame is graded and written, the next is rendered, into the memory of the one
    // before.  A large frame is written first, since two of 8k and a graded one would take more
    // than 1.5 GiB.
    const bool large =
        std::int64_t{columns(run_.show.projection)} * rows(run_.show.projection) > kMostPixelsOfTwo;
    std::future<void> writing;
    auto frame = std::make_shared<HalfFrame>(), written = std::make_shared<HalfFrame>();
    for (const int number : run_.frames) {
      stop_if_interrupted();
      const FrameState state = frame_state(run_.show, number);
      const std::string key = keys_.scene(state);
      const bool linear_good = is_linear_good(state, key);
      const bool graded_good = is_graded_good(state, key);
      if (linear_good && graded_good) {
        progress.skipped();
        continue;
      }
      if (linear_good)
        *frame = read_frame(linear_path(number)).first;
      else
        render(state, *frame);
      if (writing.valid()) writing.get(), progress.made();
      writing = std::async(std::launch::async, [this, state, key, frame, linear_good, graded_good] {
        write(state, key, *frame, !linear_good, !graded_good);
      });
      if (large)
        writing.get(), progress.made();
      else
        std::swap(frame, written);
    }
    if (writing.valid()) writing.get(), progress.made();
    std::fprintf(stderr, "%zu frames made, %zu already there, in %.1f s: %s\n",
                 progress.made_count(), progress.skipped_count(), progress.seconds(),
                 run_.folder.c_str());
  }

 private:
  static std::optional<Grader> grader_of(const Show& show) {
    if (show.graded_format == GradedFormat::kNone) return std::nullopt;
    return Grader(show.grade);
  }

  static void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw InputError(folder.string() + ": the folder cannot be made: " + error.message());
    sweep_temporaries(folder);
  }

  bool grades() const { return run_.show.graded_format != GradedFormat::kNone; }

  std::filesystem::path path(const char* folder, int frame, const char* extension) const {
    return run_.folder / folder / fmt::format("{}_{:05d}.{}", name_, frame, extension);
  }
  std::filesystem::path linear_path(int frame) const { return path("linear", frame, "exr"); }
  std::filesystem::path graded_path(int frame) const {
    return path("graded", frame, run_.show.graded_format == GradedFormat::kTiff ? "tif" : "png");
  }

  bool is_linear_good(const FrameState& state, const std::string& key) const {
    return examine_frame(linear_path(state.frame), key, columns(state.projection),
                         rows(state.projection)) == FrameCondition::kGood;
  }

  bool is_graded_good(const FrameState& state, const std::string& key) const {
    return !grades() ||
           examine_graded(graded_path(state.frame), keys_.graded(key), columns(state.projection),
                          rows(state.projection)) == FrameCondition::kGood;
  }

  void render(const FrameState& state, HalfFrame& frame) {
    if (!run_.render)
      throw InputError(
          linear_path(state.frame).string() +
          ": the frame is missing, damaged or of another version of the show; render it first");
    if (!renderer_) {
      renderer_.emplace(run_.show, run_.threads);
      // All that the run needs is loaded at once, so that a damaged file ends it before its first
      // frame.
      for (const int number : run_.frames) {
        const FrameState other = frame_state(run_.show, number);
        renderer_->load(plan_frame(run_.show, other));
        if (other.vanishing) renderer_->load(plan_frame(run_.show, *other.vanishing));
      }
    }
    StageTimes times;
    try {
      renderer_->render(state, frame, &times);
      if (run_.explain)
        std::fprintf(stderr, "frame %d: region %s, r = %.9g M\n%s", state.frame,
                     region_name(state.observer.region), state.observer.r,
                     describe(plan_frame(run_.show, state), times).c_str());
    } catch (const std::runtime_error& error) {
      if (dynamic_cast<const InputError*>(&error)) throw;
      throw std::runtime_error(fmt::format("frame {}: {}", state.frame, error.what()));
    }
  }

  FrameInfo info(const FrameState& state, const std::string& key) const {
    FrameInfo info;
    info.title = run_.show.title;
    info.show = keys_.show();
    info.key = key;
    info.frame = state.frame;
    info.region = region_name(state.observer.region);
    info.r = steady(state.observer.r);
    info.proper_time = steady(state.observer.proper_time);
    info.frames_per_second = run_.show.frames_per_second;
    info.projection = projection_name(state.projection);
    info.software = kSoftware;
    return info;
  }

  // Writes the files that are asked for.  Packing pixels is most of the work, so the two are made
  // side by side.
  void write(const FrameState& state, const std::string& key, const HalfFrame& frame, bool linear,
             bool graded) const {
    double linear_s = 0, grade_s = 0, graded_s = 0;
    std::future<void> other;
    if (linear)
      other = std::async(std::launch::async, [&] {
        const Stopwatch watch;
        write_frame(linear_path(state.frame), frame, info(state, key));
        linear_s = watch.seconds();
      });
    if (graded) {
      const Stopwatch watch;
      grade_s = write_graded_frame(graded_path(state.frame), frame, graded_info(state, key));
      graded_s = watch.seconds();
    }
    if (other.valid()) other.get();
    if (run_.explain)
      std::fprintf(
          stderr,
          "frame %d: linear file %.3f s, graded file %.3f s, %.3f s of it waiting for the grade\n",
          state.frame, linear_s, graded_s, grade_s);
  }

  // Writes a graded file, of which some rows are graded while those before are packed.  Returns the
  // seconds spent waiting for grades.
  double write_graded_frame(const std::filesystem::path& path, const HalfFrame& frame,
                            const GradedInfo& info) const {
    constexpr int kRows = GradedFile::kRows;
    GradedFile file(path, frame.width, frame.height, info);
    const auto graded_from = [&](int first) {
      return std::async(std::launch::async, [this, &frame, first] {
        return graded_rows(frame, first, std::min(first + kRows, frame.height));
      });
    };
    double waited_s = 0;
    std::future<GradedFrame> next = graded_from(0);
    for (int first = 0; first < frame.height; first += kRows) {
      const Stopwatch watch;
      const GradedFrame rows = next.get();
      waited_s += watch.seconds();
      if (first + kRows < frame.height) next = graded_from(first + kRows);
      file.add(rows.row(0), rows.height);
    }
    file.finish();
    return waited_s;
  }

  // The rows y0 <= y < y1, of which each thread grades a part.
  GradedFrame graded_rows(const HalfFrame& frame, int y0, int y1) const {
    GradedFrame out(frame.width, y1 - y0);
    const int parts = file_threads();
    std::vector<std::future<void>> others(static_cast<std::size_t>(parts));
    for (int part = 0; part < parts; ++part)
      others[static_cast<std::size_t>(part)] = std::async(std::launch::async, [&, part] {
        const int first = out.height * part / parts, end = out.height * (part + 1) / parts;
        grader_->grade_rows(frame, y0 + first, y0 + end, out.row(first));
      });
    for (auto& other : others) other.get();
    return out;
  }

  GradedInfo graded_info(const FrameState& state, const std::string& key) const {
    GradedInfo info;
    info.key = keys_.graded(key);
    info.title = run_.show.title;
    info.frame = state.frame;
    info.display = grader_->display();
    info.view = grader_->view();
    info.software = kSoftware;
    return info;
  }

  int file_threads() const {
    return run_.threads > 0 ? run_.threads
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }

  const FrameRun& run_;
  std::optional<Grader> grader_;
  FrameKeys keys_;
  std::optional<Renderer> renderer_;
  std::string name_;
};

constexpr int kSmallest = 16, kLargest = 16384;

// The number that a text is; -1 if it is no whole number.
int whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : -1;
}

bool in_range(int pixels) { return pixels >= kSmallest && pixels <= kLargest; }

}  // namespace

void run_frames(const FrameRun& run) { Run(run).all(); }

Projection resized(const Projection& projection, const std::string& size) {
  if (size.empty()) return projection;
  if (const auto* flat = std::get_if<Stereographic>(&projection)) {
    const std::size_t cross = std::min(size.find('x'), size.size());
    const int width = whole_number(std::string_view(size).substr(0, cross));
    const int height =
        whole_number(std::string_view(size).substr(std::min(cross + 1, size.size())));
    if (!in_range(width) || !in_range(height))
      throw InputError("--size " + size +
                       ": a flat picture takes WIDTHxHEIGHT, each from 16 to 16384 pixels");
    return Stereographic{width, height, flat->fov};
  }
  int pixels = whole_number(size);
  if (size.ends_with('k')) {
    const int thousands = whole_number(std::string_view(size).substr(0, size.size() - 1));
    if (thousands == 1 || thousands == 2 || thousands == 4 || thousands == 8)
      pixels = thousands * 1024;
  }
  if (!in_range(pixels))
    throw InputError("--size " + size +
                     ": a dome takes 1k, 2k, 4k, 8k or a number of pixels from 16 to 16384");
  return Domemaster{pixels};
}

}  // namespace domefall
