#include "pipeline/theatre/movie/movie_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/base/disk_room.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/render/frames/graded_frames.h"
#include "pipeline/render/frames/progress.h"
#include "pipeline/render/keyed_renderer.h"
#include "pipeline/show/show.h"
#include "pipeline/theatre/movie/burn_in.h"

namespace domefall {
namespace {

// A backslash takes their meaning from these characters, and a line break ends a value.
std::string escaped(const std::string& value) {
  std::string text;
  for (const char c : value) {
    if (std::string_view("=;#\\\n").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

// Returns the markers of a show as the chapters of a movie of the frames [first, first + count), as
// ffmpeg reads them (ffmetadata), each from its marker to the next one.  Before the first marker
// lies a chapter with the show's title.  The text is empty for a show without markers.
std::string chapters(const Show& show, int first, int count) {
  if (show.markers.empty()) return "";
  const double begin = first / show.frames_per_second, end = begin + count / show.frames_per_second;
  std::vector<Marker> markers{{show.title, begin}};
  double latest = -1;  // of the markers up to the first frame, the last of which names its chapter
  for (const Marker& marker : show.markers) {
    if (marker.at_s >= end) continue;
    if (marker.at_s > begin)
      markers.push_back(marker);
    else if (marker.at_s >= latest)
      markers[0].name = marker.name, latest = marker.at_s;
  }
  std::ranges::stable_sort(markers, {}, &Marker::at_s);
  constexpr double kThousand = 1000;
  std::string text = ";FFMETADATA1\n";
  for (std::size_t k = 0; k < markers.size(); ++k) {
    const auto at = [&](double seconds) { return std::lround((seconds - begin) * kThousand); };
    text += fmt::format("[CHAPTER]\nTIMEBASE=1/1000\nSTART={}\nEND={}\ntitle={}\n",
                        at(markers[k].at_s), at(k + 1 < markers.size() ? markers[k + 1].at_s : end),
                        escaped(markers[k].name));
  }
  return text;
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
  progress.end();
  say(fmt::format("{} frame{}, {:.3f} s at {} a second, made in {:.1f} s: {}", run.frames.size(),
                  run.frames.size() == 1 ? "" : "s", duration_of(run.plan.count, run.plan.rate),
                  text_of(run.plan.rate), progress.seconds(), run.out.string()));
}

// Calls step(frame) for the finished frames in their order, and unpacks the next ones meanwhile.
template <class Step>
void for_each_frame(const MovieRun& run, const GradedFrames& finished, const Step& step) {
  std::deque<std::future<GradedFrame>> ahead;
  std::size_t next = 0;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    for (; next < run.frames.size() && ahead.size() < frames_ahead(run); ++next)
      ahead.push_back(std::async(std::launch::async, [&finished, number = run.frames[next]] {
        return finished.read(number);
      }));
    const GradedFrame frame = ahead.front().get();
    ahead.pop_front();
    step(frame);
  }
}

void say_levels(const LightLevels& levels) {
  say(fmt::format("light levels: MaxCLL {:.1f}, MaxFALL {:.1f} cd/m^2", levels.content,
                  levels.frame_average));
}

// The encoder wants them before the first frame, so that all frames are read once more for them.
LightLevels measured_levels(const MovieRun& run, const GradedFrames& finished) {
  LightLevels levels;
  for_each_frame(run, finished, [&](const GradedFrame& frame) {
    FrameLevels of_frame(frame.width, frame.height);
    of_frame.take(0, frame.height, frame.pixels.data());
    of_frame.add_to(levels);
  });
  say_levels(levels);
  return levels;
}

// Adds a frame to a movie, and takes its levels while its rows are made.
void add_measured(const RowPicture& frame, MovieFile& movie, LightLevels& levels) {
  FrameLevels of_frame(frame.width, frame.height);
  movie.add({frame.width, frame.height, [&](int first, int end, unsigned short* rgb) {
               frame.rows(first, end, rgb);
               of_frame.take(first, end, rgb);
             }});
  of_frame.add_to(levels);
}

}  // namespace

MoviePlan plan_movie(const MoviePreset& preset, const Show& show, const std::vector<int>& frames,
                     Sound sound, const std::filesystem::path& out) {
  if (frames.back() - frames.front() + 1 != std::ssize(frames))
    throw InputError("--frames " + as_ranges(frames) +
                     ": the frames of a movie follow one another; name one range, such as 0-299");
  const Projection& projection = show.projection;
  if (preset.whole_sphere && !std::holds_alternative<Equirectangular>(projection))
    throw InputError(
        fmt::format("--preset {}: takes frames of the projection {}, and those of this show are {}",
                    preset.name, Equirectangular::kTraits.name, projection_name(projection)));
  const MovieSize size{columns(projection), rows(projection), pixel_aspect(projection)};
  const MovieSize made = movie_size(preset, size);
  MoviePlan plan{preset,
                 show.title,
                 size,
                 frame_rate_of(show.frames_per_second),
                 frames.front(),
                 static_cast<int>(frames.size()),
                 {},
                 std::move(sound),
                 preset.burn_in ? burn_in(show, {frames.front()}, made) : std::string()};
  plan.chapters = chapters(show, plan.first, plan.count);
  require_fitting(preset, plan.rate, plan.sound);
  const double least = least_bytes(preset, made, plan.count, plan.rate, plan.sound.channels);
  require_room(
      out, least,
      fmt::format("a movie of {} frames of {} x {} pixels takes at least {}, which is "
                  "that of black frames ({} bits a pixel){}",
                  plan.count, made.width, made.height, bytes_text(least), preset.least_bits,
                  preset.whole_sphere ? ", twice while it is made" : ""));
  try_movie(plan);
  return plan;
}

void movie_of_finished(const MovieRun& run, const std::filesystem::path& folder) {
  if (!run.show.output.graded)
    throw InputError(run.show.file.string() +
                     ": keeps no graded frames (output: {graded: none}); without --from, movie "
                     "renders and grades them itself");
  const GradedFrames finished(run.show, run.grader, folder);
  finished.check(run.frames, run.threads,
                 fmt::format("this movie takes {} x {} pixels. Another --from or --size fits them",
                             columns(run.show.projection), rows(run.show.projection)),
                 "; without --from, movie does");
  MoviePlan plan = run.plan;
  if (takes_light_levels(plan.preset, plan.tags)) plan.levels = measured_levels(run, finished);
  MovieFile movie(run.out, plan);
  Progress progress(run.frames.size());
  for_each_frame(run, finished, [&](const GradedFrame& frame) {
    movie.add({frame.width, frame.height, [&frame](int first, int end, unsigned short* rgb) {
                 std::copy(frame.row(first), frame.row(end), rgb);
               }});
    progress.made();
  });
  movie.finish();
  say_done(run, progress);
}

void movie_of_rendered(const MovieRun& run) {
  KeyedRenderer renderer(run.show, run.frames, run.grader.transform_id(), run.threads);
  FrameGrading grading(run.grader, run.threads);
  // The encoder wants the levels before the first frame, and they are known after the last one.
  const bool measures = takes_light_levels(run.plan.preset, run.plan.tags);
  MoviePlan plan = run.plan;
  if (measures) plan.levels = kLevelsToCome;
  LightLevels levels;
  MovieFile movie(run.out, plan);
  Progress progress(run.frames.size());
  auto rendered = std::make_unique<LayeredHalfFrame>(),
       taken = std::make_unique<LayeredHalfFrame>();
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
    taking = std::async(std::launch::async, [&, state, frame = taken.get()] {
      grading.grade(frame->picture, state, [&](const RowPicture& rows) {
        measures ? add_measured(rows, movie, levels) : movie.add(rows);
      });
    });
  }
  finish();
  if (measures) say_levels(levels);
  movie.finish(measures ? std::optional(levels) : std::nullopt);
  say_done(run, progress);
}

}  // namespace domefall
