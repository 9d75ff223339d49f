#include "pipeline/cli/frame_run.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <future>
#include <optional>

#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/keyed_renderer.h"
#include "pipeline/cli/progress.h"
#include "pipeline/farm/brightest_value.h"
#include "pipeline/farm/manifest.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_condition.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/render/rays/steady.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/render/thread_limit.h"

namespace domefall {
namespace {

// Larger frames are made one at a time.
constexpr std::int64_t kMostPixelsOfTwo = 40'000'000;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A Run holds what a run makes once, such as the grader, the keys and the renderer.
class Run {
 public:
  explicit Run(const FrameRun& run)
      : run_(run),
        folder_(run.folder, run.show),
        manifest_(run.folder),
        grader_(grader_of(run.show)),
        renderer_(run.show, run.frames, grade_id(), run.threads, run.explain) {
    if (grader_) grading_.emplace(*grader_, all_threads(run.threads));
    catch_interruptions();
  }

  // Says what the run will do with the files that are there, and returns the frames that it will
  // make.  Throws InputError if it may not make them.
  std::vector<int> survey() {
    const FrameSurvey found = survey_frames(folder_, run_.show, keys(), run_.frames, run_.render);
    if (!run_.replace) {
      refuse_to_replace(found, folder_);
      folder_.check_owner();
    }
    std::fputs((describe_work(found) + describe_strangers(folder_)).c_str(), stderr);
    return found.to_make;
  }

  void prepare() {
    const int threads = all_threads(run_.threads);
    require_threads(threads);
    set_file_threads(threads);
    folder_.prepare(run_.frames);
  }

  void all() {
    Progress progress(run_.frames.size(), run_.progress);
    int being_written = 0;
    // While one frame is graded and written, the next is rendered into the memory of the frame
    // before.  A large frame is written before the next is rendered, since two frames of 8k and a
    // graded one would take more than 1.5 GiB.
    const bool large =
        std::int64_t{columns(run_.show.projection)} * rows(run_.show.projection) > kMostPixelsOfTwo;
    std::future<void> writing;
    const auto finish = [&] {
      if (!writing.valid()) return;
      writing.get();
      if (progress.made_count() == 0) folder_.write_record();
      progress.made(being_written);
    };
    auto frame = std::make_shared<RenderedFrame>(), written = std::make_shared<RenderedFrame>();
    for (const int number : run_.frames) {
      stop_if_interrupted();
      const FrameState state = frame_state(run_.show, number);
      const std::string key = keys().scene(state);
      const bool linear_good = has_good_linear(number, key);
      const bool graded_good =
          !grader_ || is_good(folder_.graded(number), keys().graded(key, state), true);
      if (graded_good && (linear_good || !folder_.has_linear() || !run_.render)) {
        progress.skipped(number);
        continue;
      }
      const Stopwatch watch;
      if (linear_good || run_.render) manifest_.begin(number);
      if (linear_good)
        frame->half = read_frame(folder_.linear(number)).first;
      else if (run_.render)
        render_for_files(renderer_, run_.show, state, *frame);
      else {
        missing_.push_back(number);
        continue;
      }
      const double render_s = watch.seconds();
      finish();
      being_written = number;
      writing = std::async(std::launch::async, [=, this] {
        write(state, key, *frame, !linear_good && folder_.has_linear(), !graded_good, render_s);
      });
      if (large)
        finish();
      else
        std::swap(frame, written);
    }
    finish();
    if (progress.made_count() == 0) folder_.write_record();
    std::fprintf(stderr, "%zu frames made, %zu already there, in %.1f s: %s\n",
                 progress.made_count(), progress.skipped_count(), progress.seconds(),
                 run_.folder.c_str());
    if (!missing_.empty()) fail_for_missing();
  }

 private:
  static std::optional<Grader> grader_of(const Show& show) {
    if (!show.output.graded) return std::nullopt;
    return Grader(show.grade);
  }

  std::string grade_id() const {
    return grader_ ? grader_->transform_id() + format_id(*run_.show.output.graded) : std::string();
  }

  // Says whether the frame can be graded from its scene-linear file.
  bool has_good_linear(int number, const std::string& key) const {
    return (folder_.has_linear() || !run_.render) &&
           is_good(folder_.linear(number), key, run_.render);
  }

  // Another run may yet render the frames that are missing, so they are worth trying again later.
  // A show that keeps no scene-linear files never will have them.
  [[noreturn]] void fail_for_missing() const {
    const bool one = missing_.size() == 1;
    const std::string what = fmt::format(
        "{}: {} frame{} not graded: {}. Scene-linear files are missing, damaged, or of "
        "another size or version of the show",
        folder_.linear(missing_.front()).string(), missing_.size(), one ? " was" : "s were",
        as_ranges(missing_));
    if (!folder_.has_linear())
      throw InputError(what +
                       "; with output: {linear: none} domefall render makes graded frames "
                       "alone, and makes them again where the grade is another");
    throw TemporaryError(what + "; render them first");
  }

  bool is_good(const std::filesystem::path& file, const std::string& key, bool replaces) const {
    const WantedFrame wanted = folder_.wanted(key);
    const FrameCondition condition = examine_frame(file, wanted);
    // Another run may have put the file there since the survey.
    if (condition == FrameCondition::kOther && replaces && !run_.replace)
      throw InputError(fmt::format("{}: a good frame, but another one than this run makes ({})",
                                   file.string(), describe_difference(file, wanted)));
    return condition == FrameCondition::kGood;
  }

  const FrameKeys& keys() const { return renderer_.keys(); }

  FrameInfo info(const FrameState& state, const std::string& key) const {
    FrameInfo info;
    info.title = run_.show.title;
    info.show = keys().show();
    info.key = key;
    info.frame = state.frame;
    info.region = region_name(state.observer.region);
    info.r = steady(state.observer.r);
    info.proper_time = steady(state.observer.proper_time);
    info.frames_per_second = run_.show.frames_per_second;
    info.projection = projection_name(state.projection);
    info.software = kSoftware;
    info.owner = run_.show.output.owner;
    return info;
  }

  // Writes the files that are asked for, side by side, so that one is packed while the other waits
  // for the disk.
  void write(const FrameState& state, const std::string& key, const RenderedFrame& frame,
             bool linear, bool graded, double render_s) {
    const Stopwatch all;
    double linear_s = 0, graded_s = 0;
    std::atomic<unsigned short> brightest{0};
    std::future<void> other;
    if (linear)
      other = std::async(std::launch::async, [&] {
        const Stopwatch watch;
        write_linear(folder_.linear(state.frame), run_.show, frame, info(state, key));
        linear_s = watch.seconds();
      });
    if (graded) {
      const Stopwatch watch;
      // Rows are graded by the threads that pack them.
      grading_->grade(frame.half, state, [&](const RowPicture& rows) {
        write_graded(folder_.graded(state.frame),
                     manifest_.is_on() ? watched(rows, brightest) : rows, graded_info(state, key),
                     *run_.show.output.graded);
      });
      graded_s = watch.seconds();
    }
    if (other.valid()) other.get();
    const double took_s = render_s + all.seconds();
    if (linear && manifest_.is_on())
      manifest_.made(state.frame, folder_.linear(state.frame), took_s, brightest_value(frame.half));
    constexpr double kWhite = 65535;
    if (graded)
      manifest_.made(state.frame, folder_.graded(state.frame), took_s, brightest / kWhite);
    if (run_.explain)
      std::fprintf(stderr, "frame %d: linear file %.3f s, graded file %.3f s\n%s", state.frame,
                   linear_s, graded_s, graded ? describe_grade(frame.half).c_str() : "");
  }

  // Says by what the frame was graded, and how exactly.
  std::string describe_grade(const HalfFrame& frame) const {
    const auto table = grading_->table_error(frame);
    if (!table) return "grade by formulas\n";
    constexpr double kCodes = 4095;
    return fmt::format(
        "grade by a table, to {:.2f} of a 12-bit code; {:.1f} % of it left to the formulas\n",
        kCodes * table->error, 100 * (1 - table->held));
  }

  GradedInfo graded_info(const FrameState& state, const std::string& key) const {
    GradedInfo info;
    info.key = keys().graded(key, state);
    info.title = run_.show.title;
    info.frame = state.frame;
    info.display = grader_->display();
    info.view = grader_->view();
    info.colour = grader_->colour();
    info.software = kSoftware;
    info.projection = projection_name(state.projection);
    return info;
  }

  const FrameRun& run_;
  FrameFolder folder_;
  ManifestWriter manifest_;
  std::optional<Grader> grader_;
  std::optional<FrameGrading> grading_;
  KeyedRenderer renderer_;
  std::vector<int> missing_;  // frames to be graded whose scene-linear files are not good
};

}  // namespace

std::vector<int> frames_to_make(const FrameRun& run) { return Run(run).survey(); }

void run_frames(const FrameRun& run) {
  Run made(run);
  const std::vector<int> to_make = made.survey();
  if (run.dry) {
    if (!to_make.empty()) fmt::print("{}\n", as_ranges(to_make));
    return;
  }
  made.prepare();
  made.all();
}

}  // namespace domefall
