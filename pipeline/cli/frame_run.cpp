#include "pipeline/cli/frame_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <future>
#include <optional>
#include <stdexcept>
#include <thread>

#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/progress.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_condition.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/renderer.h"
#include "pipeline/render/thread_limit.h"

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
      : run_(run), folder_(run.folder, run.show), grader_(grader_of(run.show)) {
    keys_.emplace(run.show, grade_id());
    catch_interruptions();
  }

  // Says what the run will do with what is there.  Throws InputError if it may not.
  void survey() {
    const FrameSurvey found = survey_frames(folder_, run_.show, *keys_, run_.frames, run_.render);
    if (!run_.replace) {
      refuse_to_replace(found, folder_);
      folder_.check_owner();
    }
    std::fputs((describe_work(found) + describe_strangers(folder_)).c_str(), stderr);
    if (run_.dry && !found.to_make.empty()) fmt::print("{}\n", as_ranges(found.to_make));
  }

  void prepare() {
    require_threads(file_threads());
    set_file_threads(file_threads());
    folder_.prepare(run_.frames);
  }

  void all() {
    Progress progress(run_.frames.size());
    // While one frame is graded and written, the next is rendered, into the memory of the one
    // before.  A large frame is written first, since two of 8k and a graded one would take more
    // than 1.5 GiB.
    const bool large =
        std::int64_t{columns(run_.show.projection)} * rows(run_.show.projection) > kMostPixelsOfTwo;
    std::future<void> writing;
    const auto finish = [&] {
      if (!writing.valid()) return;
      writing.get();
      if (progress.made_count() == 0) folder_.write_record();
      progress.made();
    };
    auto frame = std::make_shared<HalfFrame>(), written = std::make_shared<HalfFrame>();
    for (const int number : run_.frames) {
      stop_if_interrupted();
      const FrameState state = frame_state(run_.show, number);
      const std::string key = keys_->scene(state);
      const bool linear_good = has_good_linear(number, key);
      const bool graded_good =
          !grader_ || is_good(folder_.graded(number), keys_->graded(key, state), true);
      if (graded_good && (linear_good || !folder_.has_linear() || !run_.render)) {
        progress.skipped();
        continue;
      }
      if (linear_good)
        *frame = read_frame(folder_.linear(number)).first;
      else if (run_.render)
        render_as_keyed(state, *frame);
      else {
        missing_.push_back(number);
        continue;
      }
      finish();
      writing = std::async(std::launch::async, [this, state, key, frame, linear_good, graded_good] {
        write(state, key, *frame, !linear_good && folder_.has_linear(), !graded_good);
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

  // Whether the frame can be graded from its scene-linear file.
  bool has_good_linear(int number, const std::string& key) const {
    return (folder_.has_linear() || !run_.render) &&
           is_good(folder_.linear(number), key, run_.render);
  }

  // Frames that another run may yet render are for later; of a show that keeps no scene-linear
  // files there never will be any.
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
    // Another run may have put it there since the survey.
    if (condition == FrameCondition::kOther && replaces && !run_.replace)
      throw InputError(fmt::format("{}: a good frame, but another one than this run makes ({})",
                                   file.string(), describe_difference(file, wanted)));
    return condition == FrameCondition::kGood;
  }

  // The keys hold digests of the assets as they were when the run began, and the renderer reads
  // them later.  So a frame counts only if nothing has touched them until it was rendered.
  void render_as_keyed(const FrameState& state, HalfFrame& frame) {
    for (;;) {
      render(state, frame);
      const auto touched = keys_->touched_asset();
      if (!touched) return;
      if (!assets_are_the_same())
        throw TemporaryError(touched->string() +
                             ": the file was changed while the run was reading it; run again");
      renderer_.reset();
    }
  }

  // Takes the digests of the assets again, and keeps the new keys if they are those of before.
  bool assets_are_the_same() {
    try {
      FrameKeys now(run_.show, grade_id());
      if (!now.same_assets(*keys_)) return false;
      keys_.emplace(std::move(now));
      return true;
    } catch (const InputError&) {  // one is gone
      return false;
    } catch (const TemporaryError&) {  // one went while it was read
      return false;
    }
  }

  void render(const FrameState& state, HalfFrame& frame) {
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
    info.show = keys_->show();
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

  // Writes the files that are asked for, side by side: while one waits for the disk, the other is
  // packed.
  void write(const FrameState& state, const std::string& key, const HalfFrame& frame, bool linear,
             bool graded) {
    double linear_s = 0, graded_s = 0;
    std::future<void> other;
    if (linear)
      other = std::async(std::launch::async, [&] {
        const Stopwatch watch;
        write_frame(folder_.linear(state.frame), frame, info(state, key), *run_.show.output.linear);
        linear_s = watch.seconds();
      });
    if (graded) {
      const Stopwatch watch;
      frame_grader_ = frame_grader_.value_or(*grader_).with(state.cdl);
      write_graded_frame(folder_.graded(state.frame), frame, graded_info(state, key));
      graded_s = watch.seconds();
    }
    if (other.valid()) other.get();
    if (run_.explain)
      std::fprintf(stderr, "frame %d: linear file %.3f s, graded file %.3f s\n%s", state.frame,
                   linear_s, graded_s, graded ? describe_grade(frame).c_str() : "");
  }

  // By what the frame was graded, and how exactly.
  std::string describe_grade(const HalfFrame& frame) const {
    const auto table = frame_grader_->table_error(frame);
    if (!table) return "grade by formulas\n";
    constexpr double kCodes = 4095;
    return fmt::format(
        "grade by a table, to {:.2f} of a 12-bit code; {:.1f} % of it left to the formulas\n",
        kCodes * table->error, 100 * (1 - table->held));
  }

  // Rows are graded by the threads that pack them.  With the dome's own light all are graded before
  // the first is packed, since the light of each falls on all others.
  void write_graded_frame(const std::filesystem::path& path, const HalfFrame& frame,
                          const GradedInfo& info) const {
    const auto write = [&](const RowSource& rows) {
      write_graded(path, {frame.width, frame.height, rows}, info, *run_.show.output.graded);
    };
    if (!grader_->dome_light())
      return write([&](int first, int end, unsigned short* rgb) {
        frame_grader_->grade_rows(frame, first, end, rgb);
      });
    const GradedFrame whole = with_dome_light(frame);
    write([&](int first, int end, unsigned short* rgb) {
      std::copy(whole.row(first), whole.row(end), rgb);
    });
  }

  GradedFrame with_dome_light(const HalfFrame& frame) const {
    GradedFrame whole = graded_rows(frame, 0, frame.height);
    std::vector<DomeCodes> parts(static_cast<std::size_t>(file_threads()));
    in_parts(whole.height, [&](int part, int first, int end) {
      parts[static_cast<std::size_t>(part)].add_rows(whole, first, end);
    });
    for (std::size_t k = 1; k < parts.size(); ++k) parts[0].add(parts[k]);
    const CodeMap map = grader_->dome_light()->map_for(parts[0]);
    in_parts(whole.height, [&](int, int first, int end) { map.change_rows(whole, first, end); });
    return whole;
  }

  // The rows y0 <= y < y1, of which each thread grades a part.
  GradedFrame graded_rows(const HalfFrame& frame, int y0, int y1) const {
    GradedFrame out(frame.width, y1 - y0);
    in_parts(out.height, [&](int, int first, int end) {
      frame_grader_->grade_rows(frame, y0 + first, y0 + end, out.row(first));
    });
    return out;
  }

  // Calls step(part, first, end) for as many parts of the rows as there are threads, side by side.
  template <class Step>
  void in_parts(int rows, const Step& step) const {
    const int parts = file_threads();
    std::vector<std::future<void>> others(static_cast<std::size_t>(parts));
    for (int part = 0; part < parts; ++part)
      others[static_cast<std::size_t>(part)] = std::async(std::launch::async, [&, part] {
        step(part, rows * part / parts, rows * (part + 1) / parts);
      });
    for (auto& other : others) other.get();
  }

  GradedInfo graded_info(const FrameState& state, const std::string& key) const {
    GradedInfo info;
    info.key = keys_->graded(key, state);
    info.title = run_.show.title;
    info.frame = state.frame;
    info.display = grader_->display();
    info.view = grader_->view();
    info.colour = grader_->colour();
    info.software = kSoftware;
    info.projection = projection_name(state.projection);
    return info;
  }

  int file_threads() const {
    return run_.threads > 0 ? run_.threads
                            : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }

  const FrameRun& run_;
  FrameFolder folder_;
  std::optional<Grader> grader_;        // of the show
  std::optional<Grader> frame_grader_;  // of the frame that is written, and kept for those after it
  std::optional<FrameKeys> keys_;
  std::optional<Renderer> renderer_;
  std::vector<int> missing_;  // frames to be graded whose scene-linear files are not good
};

}  // namespace

void run_frames(const FrameRun& run) {
  Run made(run);
  made.survey();
  if (run.dry) return;
  made.prepare();
  made.all();
}

}  // namespace domefall
