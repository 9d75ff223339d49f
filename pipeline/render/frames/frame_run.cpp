#include "pipeline/render/frames/frame_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <future>
#include <optional>

#include "pipeline/base/errors.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/stop_watch.h"
#include "pipeline/base/talk.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/render/frames/brightest_value.h"
#include "pipeline/render/frames/frame_findings.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/frames/graded_frames.h"
#include "pipeline/render/frames/manifest.h"
#include "pipeline/render/frames/progress.h"
#include "pipeline/render/keyed_renderer.h"
#include "pipeline/render/rays/key_rounding.h"
#include "pipeline/render/rendered_frame.h"
#include "pipeline/render/thread_limit.h"
#include "pipeline/show/camera_world.h"

namespace domefall {
namespace {

// Larger frames are made one at a time.
constexpr std::int64_t kMostPixelsOfTwo = 40'000'000;

// A Run holds what a run makes once, such as the grader, the keys and the renderer.
class Run {
 public:
  explicit Run(const FrameRun& run)
      : run_(run),
        folder_(run.folder, run.show),
        manifest_(run.folder),
        grader_(grader_of(run.show)),
        renderer_(run.show, run.frames, grade_id(run.show, grader_ ? &*grader_ : nullptr),
                  run.threads, run.explain) {
    if (grader_) grading_.emplace(*grader_, all_threads(run.threads));
    catch_interruptions();
  }

  // Says what the run will do with the files that are there, and returns the frames that it will
  // make.  Throws InputError if it may not make them.
  std::vector<int> survey() {
    const FolderFindings found = survey_files(
        folder_.files(run_.frames, keys(), run_.render ? FrameFiles::kAll : FrameFiles::kGraded));
    if (!run_.replace) {
      refuse_to_replace(found, folder_);
      folder_.check_owner();
    }
    if (const std::string note = ocio_note(run_.show.grade); !note.empty() && grader_) say(note);
    const std::string foreign = describe_foreign(folder_.foreign_files(), folder_);
    const std::string text = describe_work(found, run_.show) +
                             (foreign.empty() ? "" : run_.folder.string() + ": " + foreign);
    if (!text.empty()) say(text);
    return found.to_make();
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
    auto frame = std::make_shared<RenderedFrame>(run_.show),
         written = std::make_shared<RenderedFrame>(run_.show);
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
      const StopWatch watch;
      if (linear_good || run_.render) manifest_.begin(number);
      if (linear_good)
        frame->half.picture = read_frame(folder_.linear(number)).first;
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
    progress.end();
    say(fmt::format("{} frames made, {} already there, in {:.1f} s: {}", progress.made_count(),
                    progress.skipped_count(), progress.seconds(), run_.folder.string()));
    if (!missing_.empty()) fail_for_missing();
  }

 private:
  static std::optional<Grader> grader_of(const Show& show) {
    if (!show.output.graded) return std::nullopt;
    return Grader(show.grade);
  }

  // Says whether the frame can be graded from its scene-linear file.
  bool has_good_linear(int number, const std::string& key) const {
    return (folder_.has_linear() || !run_.render) &&
           is_good(folder_.linear(number), key, run_.render) &&
           (!run_.render || std::ranges::all_of(folder_.layers(), [&](Layer layer) {
             return is_good(folder_.layer(number, layer), FrameKeys::layer(key, layer), true);
           }));
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
    const FrameCheck found = check_frame(file, folder_.wanted(key));
    // Another run may have put the file there since the survey.
    if (found.condition == FrameCondition::kOther && replaces && !run_.replace)
      throw InputError(fmt::format("{}: a good frame, but another one than this run makes ({})",
                                   file.string(), found.reason));
    return found.condition == FrameCondition::kGood;
  }

  const FrameKeys& keys() const { return renderer_.keys(); }

  // Writes the files that are asked for, side by side, so that one is packed while the other waits
  // for the disk.
  void write(const FrameState& state, const std::string& key, RenderedFrame& frame, bool linear,
             bool graded, double render_s) {
    const StopWatch all;
    double linear_s = 0, graded_s = 0;
    std::atomic<unsigned short> brightest{0};
    std::future<void> other;
    if (linear)
      other = std::async(std::launch::async, [&] {
        const StopWatch watch;
        FrameInfo info = frame_info(run_.show, keys().show(), state, state.observer, key);
        write_linear(folder_.linear(state.frame), run_.show, frame, info);
        for (const Layer layer : folder_.layers()) {
          info.key = FrameKeys::layer(key, layer);
          write_layer_of(folder_.layer(state.frame, layer), run_.show, layer, frame, info);
        }
        linear_s = watch.seconds();
      });
    if (graded) {
      const StopWatch watch;
      // Rows are graded by the threads that pack them.
      grading_->grade(frame.half.picture, state, [&](const RowPicture& rows) {
        write_graded(folder_.graded(state.frame),
                     manifest_.is_on() ? watched(rows, brightest) : rows,
                     graded_info(run_.show, state.projection, state.frame, *grader_,
                                 keys().graded(key, state)),
                     *run_.show.output.graded);
      });
      graded_s = watch.seconds();
    }
    if (other.valid()) other.get();
    const double took_s = render_s + all.seconds();
    if (linear && manifest_.is_on()) {
      manifest_.made(state.frame, folder_.linear(state.frame), took_s,
                     brightest_value(frame.half.picture));
      for (const Layer layer : folder_.layers())
        manifest_.made(state.frame, folder_.layer(state.frame, layer), took_s,
                       brightest_value(RenderedFrame::keeps_floats(run_.show)
                                           ? half_frame(frame.full.find(layer)->light)
                                           : frame.half.find(layer)->light));
    }
    constexpr double kWhite = 65535;
    if (graded)
      manifest_.made(state.frame, folder_.graded(state.frame), took_s, brightest / kWhite);
    if (run_.explain)
      say(fmt::format("frame {}: linear file {:.3f} s, graded file {:.3f} s\n{}", state.frame,
                      linear_s, graded_s, graded ? describe_grade(frame.half.picture) : ""));
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

  const FrameRun& run_;
  FrameFolder folder_;
  ManifestWriter manifest_;
  std::optional<Grader> grader_;
  std::optional<FrameGrading> grading_;
  KeyedRenderer renderer_;
  std::vector<int> missing_;  // frames to be graded whose scene-linear files are not good
};

// Returns a matrix with these columns for the point (x, y, z, 1), which has its components in the
// world, rounded to what all processors agree on.
ExrMatrix matrix_of(const V3d& x, const V3d& y, const V3d& z, const V3d& w, float last) {
  constexpr double kSteps = 1e7;
  ExrMatrix m{};
  int column = 0;
  for (const V3d& v : {x, y, z, w}) {
    for (int row = 0; row < 3; ++row)
      m.rows[4 * row + column] = static_cast<float>(std::round(v[row] * kSteps) / kSteps + 0.0);
    ++column;
  }
  m.rows[15] = last;
  return m;
}

// The attributes' camera has x to the right, y up and z ahead (ImfStandardAttributes.h).
ExrMatrix world_to_camera(const M33d& world_from_camera) {
  return matrix_of(column(world_from_camera, 0), column(world_from_camera, 1),
                   -column(world_from_camera, 2), {0, 0, 0}, 1);
}

// A place in the picture is (0, 0) at its upper left corner and (1, 1) at its lower right one.  The
// last component is the distance ahead.
std::optional<ExrMatrix> world_to_ndc(const M33d& world_from_camera, const Projection& p) {
  if (!traits_of(p).keeps_lines) return std::nullopt;
  const double half_width = std::tan(*field_of_view(p) / 2),
               half_height = half_width * rows(p) / columns(p) / pixel_aspect(p);
  const V3d ahead = -column(world_from_camera, 2);
  return matrix_of(ahead / 2 + column(world_from_camera, 0) / (2 * half_width),
                   ahead / 2 - column(world_from_camera, 1) / (2 * half_height), ahead, ahead, 0);
}

}  // namespace

FrameInfo frame_info(const Show& show, const std::string& digest, const FrameState& state,
                     const ObserverState& observer, const std::string& key) {
  const M33d camera = world_from_camera(observer, state.projection);
  return {.title = show.title,
          .show = digest,
          .key = key,
          .frame = state.frame,
          .region = region_name(observer.region, observer.universe),
          .r = rounded_for_key(observer.r),
          .proper_time = rounded_for_key(observer.proper_time),
          .frames_per_second = show.frames_per_second,
          .projection = std::string(projection_name(state.projection)),
          .software = kSoftware,
          .owner = show.output.owner,
          .world_to_camera = world_to_camera(camera),
          .world_to_ndc = world_to_ndc(camera, state.projection),
          .pixel_aspect = pixel_aspect(state.projection)};
}

GradedInfo graded_info(const Show& show, const Projection& projection, int frame,
                       const Grader& grader, const std::string& key) {
  OpaqueColumns opaque;
  if (show.output.graded && show.output.graded->alpha)
    opaque = [projection](int row) {
      const ColumnRange inside = inside_columns(projection, row);
      return std::pair(inside.first, inside.last + 1);
    };
  return {.key = key,
          .title = show.title,
          .frame = frame,
          .display = grader.display(),
          .view = grader.view(),
          .software = kSoftware,
          .projection = std::string(projection_name(projection)),
          .colour = grader.colour(),
          .opaque = opaque,
          .pixel_aspect = pixel_aspect(projection)};
}

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
