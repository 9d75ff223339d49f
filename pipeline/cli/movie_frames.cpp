#include "pipeline/cli/movie_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <future>
#include <memory>
#include <string>

#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/cli/keyed_renderer.h"
#include "pipeline/cli/progress.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/image/read_graded.h"
#include "pipeline/render/frame_grading.h"

namespace domefall {
namespace {

// FinishedFrames are the graded frames of a folder, with the keys that they must have.
class FinishedFrames {
 public:
  FinishedFrames(const MovieRun& run, const std::filesystem::path& folder)
      : run_(run),
        folder_(folder, run.show),
        keys_(run.show, run.grader.transform_id() + format_id(*run.show.output.graded)) {}

  std::filesystem::path file(int frame) const { return folder_.graded(frame); }

  WantedFrame wanted(int frame) const {
    const FrameState state = frame_state(run_.show, frame);
    return folder_.wanted(keys_.graded(keys_.scene(state), state));
  }

  // Throws as movie_of_finished().
  void check() const {
    std::array<std::vector<int>, kConditions> found;
    const std::vector<FrameCondition> conditions = examine();
    for (std::size_t k = 0; k < conditions.size(); ++k)
      found[static_cast<std::size_t>(conditions[k])].push_back(run_.frames[k]);
    const auto of = [&](FrameCondition condition) -> const std::vector<int>& {
      return found[static_cast<std::size_t>(condition)];
    };
    const std::size_t good = of(FrameCondition::kGood).size();
    if (good == run_.frames.size()) return;
    std::string what = fmt::format("{}: {} of {} frames cannot be used", folder_.path().string(),
                                   run_.frames.size() - good, run_.frames.size());
    const auto add = [&](FrameCondition condition, const char* words) {
      if (!of(condition).empty())
        what += fmt::format("\n  {}: {}", words, as_ranges(of(condition)));
    };
    add(FrameCondition::kMissing, "missing");
    add(FrameCondition::kDamaged, "damaged");
    add(FrameCondition::kOlder, "of another version of the show or of its grade");
    const auto& others = of(FrameCondition::kOther);
    add(FrameCondition::kOther, "of another size, show or kind");
    if (!others.empty())
      throw InputError(
          fmt::format("{}\nsuch as {} ({}); this movie takes {} x {} pixels. Another --from or "
                      "--size fits them",
                      what, file(others.front()).string(),
                      describe_difference(file(others.front()), wanted(others.front())),
                      columns(run_.show.projection), rows(run_.show.projection)));
    throw TemporaryError(what + "\n`domefall render` makes these; without --from, movie does");
  }

 private:
  static constexpr std::size_t kConditions = 5;

  // Examines the frames side by side, since each takes the time to read a file.
  std::vector<FrameCondition> examine() const {
    const auto threads = static_cast<std::size_t>(run_.threads);
    std::vector<FrameCondition> conditions(run_.frames.size());
    std::vector<std::future<void>> parts;
    for (std::size_t part = 0; part < threads; ++part)
      parts.push_back(std::async(std::launch::async, [&, part] {
        for (std::size_t k = part; k < conditions.size(); k += threads)
          conditions[k] = examine_frame(file(run_.frames[k]), wanted(run_.frames[k]));
      }));
    for (auto& part : parts) part.get();
    return conditions;
  }

  const MovieRun& run_;
  FrameFolder folder_;
  FrameKeys keys_;
};

GradedFrame read_finished(const FinishedFrames& frames, int number) {
  GradedFrame frame;
  if (read_graded(frames.file(number), frames.wanted(number), frame) != FrameCondition::kGood)
    throw TemporaryError(fmt::format(
        "{}: the file was changed or removed while the movie was made; nothing was kept, run again",
        frames.file(number).string()));
  return frame;
}

// Returns how many frames are unpacked ahead, within half a gibibyte but at least one.
std::size_t frames_ahead(const MovieRun& run) {
  constexpr std::size_t kMost = std::size_t{512} << 20;
  const std::size_t bytes = sizeof(unsigned short) * 3 *
                            static_cast<std::size_t>(columns(run.show.projection)) *
                            static_cast<std::size_t>(rows(run.show.projection));
  return std::clamp<std::size_t>(kMost / bytes, 1, static_cast<std::size_t>(run.threads));
}

void say_done(const MovieRun& run, const Progress& progress) {
  std::fprintf(stderr, "%zu frame%s, %.3f s at %s a second, made in %.1f s: %s\n",
               run.frames.size(), run.frames.size() == 1 ? "" : "s",
               duration_of(run.plan.count, run.plan.rate), text_of(run.plan.rate).c_str(),
               progress.seconds(), run.out.c_str());
}

}  // namespace

MovieSize movie_size_of(const MoviePreset& preset, const Projection& frames) {
  if (preset.whole_sphere && !std::holds_alternative<Equirectangular>(frames))
    throw InputError(fmt::format(
        "--preset {}: takes frames of the projection equirectangular, and those of this show are "
        "{}",
        preset.name, projection_name(frames)));
  return movie_size(preset, {columns(frames), rows(frames)});
}

void movie_of_finished(const MovieRun& run, const std::filesystem::path& folder) {
  if (!run.show.output.graded)
    throw InputError(run.show.file.string() +
                     ": keeps no graded frames (output: {graded: none}); without --from, movie "
                     "renders and grades them itself");
  const FinishedFrames finished(run, folder);
  finished.check();
  MovieFile movie(run.out, run.plan);
  Progress progress(run.frames.size());
  std::deque<std::future<GradedFrame>> ahead;
  std::size_t next = 0;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    for (; next < run.frames.size() && ahead.size() < frames_ahead(run); ++next)
      ahead.push_back(std::async(std::launch::async, [&finished, number = run.frames[next]] {
        return read_finished(finished, number);
      }));
    const GradedFrame frame = ahead.front().get();
    ahead.pop_front();
    movie.add({frame.width, frame.height, [&frame](int first, int end, unsigned short* rgb) {
                 std::copy(frame.row(first), frame.row(end), rgb);
               }});
    progress.made();
  }
  movie.finish();
  say_done(run, progress);
}

void movie_of_rendered(const MovieRun& run) {
  KeyedRenderer renderer(run.show, run.frames, run.grader.transform_id(), run.threads);
  FrameGrading grading(run.grader, run.threads);
  MovieFile movie(run.out, run.plan);
  Progress progress(run.frames.size());
  auto rendered = std::make_unique<HalfFrame>(), taken = std::make_unique<HalfFrame>();
  std::future<void> taking;
  const auto finish = [&] {
    if (!taking.valid()) return;
    taking.get();
    progress.made();
  };
  for (const int number : run.frames) {
    const FrameState state = frame_state(run.show, number);
    renderer.render(state, *rendered);
    finish();
    std::swap(rendered, taken);
    taking = std::async(std::launch::async, [&movie, &grading, state, frame = taken.get()] {
      grading.grade(*frame, state, [&movie](const RowPicture& rows) { movie.add(rows); });
    });
  }
  finish();
  movie.finish();
  say_done(run, progress);
}

}  // namespace domefall
