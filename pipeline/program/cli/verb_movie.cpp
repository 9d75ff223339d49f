#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/output_file.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/render/thread_limit.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/theatre/movie/burn_in.h"
#include "pipeline/theatre/movie/movie_frames.h"
#include "pipeline/theatre/sound/sound.h"
#include "projections/projection.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

struct MovieOptions {
  std::string show, preset, frames, size, from, out, overlays;
  std::vector<std::string> audio;
  int threads = 0;
};

std::string presets_for_help() {
  std::string text;
  for (const MoviePreset& preset : movie_presets())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", preset.name, preset.what);
  return text;
}

std::vector<std::string_view> preset_names() {
  std::vector<std::string_view> names;
  for (const MoviePreset& preset : movie_presets()) names.push_back(preset.name);
  return names;
}

MovieSize size_of(const Projection& projection) {
  return {columns(projection), rows(projection), pixel_aspect(projection)};
}

// Returns the projection of frames that are rendered for the movie.  They are no larger than the
// movie unless --size says so, since larger ones would be scaled down.
Projection fitted(const Projection& projection, const MoviePreset& preset) {
  const MovieSize frames = size_of(projection);
  if (frames.width <= preset.most_width && frames.height <= preset.most_height) return projection;
  const MovieSize size = movie_size(preset, frames);
  return with_sides(projection, size.width, size.height);
}

fs::path chosen_out(const MovieOptions& o, const Show& show, const MoviePreset& preset) {
  const std::string extension = "." + std::string(preset.extension);
  if (o.out.empty()) {
    const fs::path folder = "out";
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw_file_error(folder, error.value());
    return folder / (show.file.stem().string() + "_" + std::string(preset.name) + extension);
  }
  fs::path out = o.out;
  std::error_code none;
  const bool replaces_file = !fs::exists(out, none) || fs::is_regular_file(out, none);
  if (replaces_file && out.extension() != extension)
    throw InputError(fmt::format("--out {}: a movie of the preset {} is a {} file", out.string(),
                                 preset.name, extension));
  refuse_overwriting(out, o.show);
  for (const std::string& audio : o.audio) refuse_overwriting(out, audio);
  for (const fs::path& audio : show.audio) refuse_overwriting(out, audio);
  return out;
}

void say_tags(const MoviePreset& preset, const ColourTags& tags, const Grader& grader) {
  say(fmt::format(
      "colour: {}, range {}",
      preset.rgb ? describe(tags).substr(0, describe(tags).rfind(',')) + ", RGB" : describe(tags),
      preset.rgb ? "full" : "limited"));
  if (tags.primaries == 2 || tags.transfer == 2)
    say(
        fmt::format("the display '{}' with the view '{}' has no tag in video for its {}; a player "
                    "must be told, "
                    "or it takes BT.709",
                    grader.display(), grader.view(),
                    tags.primaries == tags.transfer ? "primaries and curve"
                    : tags.transfer == 2            ? "curve"
                                                    : "primaries"));
}

void movie(const MovieOptions& o) {
  const MoviePreset& preset = movie_preset(o.preset);
  Show show = read_show(o.show, o.size, o.overlays);
  if (o.size.empty() && o.from.empty()) show.projection = fitted(show.projection, preset);
  const std::vector<int> frames = parse_frames(o.frames, frame_count(show));
  OutputFile out(chosen_out(o, show, preset));
  MoviePlan plan = plan_movie(preset, show, frames, show_sound(show, o.audio), out.path());
  const Grader grader(show.grade);
  plan.tags = tags_of(grader.colour());
  plan.mastering = mastering_display(grader);
  if (preset.burn_in) plan.subtitles = burn_in(show, frames, movie_size(preset, plan.frames));
  say_tags(preset, plan.tags, grader);
  const int threads = all_threads(o.threads);
  require_threads(threads);
  set_file_threads(threads);
  const MovieRun run{show, frames, grader, plan, out.path(), threads};
  if (o.from.empty())
    movie_of_rendered(run);
  else
    movie_of_finished(run, o.from);
  out.finish();
}

}  // namespace

void add_movie(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "movie", "Make a movie by ffmpeg, of frames rendered for it or of finished ones");
  auto o = std::make_shared<MovieOptions>();
  add_show(*verb, o->show)->required();
  verb->add_option("--preset", o->preset, presets_for_help())
      ->type_name(one_of(preset_names()))
      ->required();
  verb->add_option("--frames", o->frames, "one range, such as 0-299; default all")
      ->type_name("FRAMES");
  add_folder(*verb, "--from", o->from,
             "take the finished frames of this folder (the --out of render); default: render "
             "them and write no files");
  verb->add_option("--size", o->size,
                   "of the frames, as for render; default the show's, or less where the preset is "
                   "smaller and frames are rendered")
      ->type_name("SIZE");
  add_file(*verb, "--audio", o->audio, kAudioHelp);
  add_file(*verb, "--out", o->out, "movie to write; default out/NAME_PRESET.mp4, .mov or .mkv")
      ->check(refuse_empty);
  add_overlay_option(*verb, o->overlays);
  add_threads(*verb, o->threads);
  verb->callback([o] { movie(*o); });
}

}  // namespace domefall
