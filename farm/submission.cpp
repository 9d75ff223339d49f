#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <system_error>

#include "farm/chunks.h"
#include "farm/engine.h"
#include "farm/plan.h"
#include "farm/rounds.h"
#include "farm/verbs.h"
#include "farm/worker_process.h"
#include "pipeline/base/disk_room.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/talk.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/render/thread_limit.h"
#include "pipeline/show/file/read_show.h"
#include "pipeline/theatre/delivery/delivery_run.h"
#include "pipeline/theatre/movie/movie_frames.h"
#include "pipeline/theatre/movie/preset.h"
#include "pipeline/theatre/sound/sound.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// ---- the program ----

fs::path this_program() {
  std::error_code error;
  fs::path self = fs::read_symlink("/proc/self/exe", error);
  if (error) throw TemporaryError("/proc/self/exe: " + error.message() + "; name --program");
  return self;
}

fs::path found_in_path(const std::string& name) {
  const char* const folders = std::getenv("PATH");
  std::istringstream stream(folders ? folders : "");
  for (std::string folder; std::getline(stream, folder, ':');) {
    fs::path file = fs::path(folder.empty() ? "." : folder) / name;
    if (access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file)) return file;
  }
  throw InputError("--program " + name + ": PATH has no such program; a path names one elsewhere");
}

void check_version(const fs::path& program) {
  std::string said;
  const WorkerEnd end = run_program({program.string(), "--version"}, said);
  const std::string line = said.substr(0, said.find('\n'));
  if (end.code != 0 || end.signal != 0)
    throw InputError("--program " + program.string() + ": does not run: " + end.text() +
                     (line.empty() ? "" : ", " + line));
  const std::string here = "domefall " DOMEFALL_VERSION;
  if (line != here)
    throw InputError("--program " + program.string() + ": is '" + line + "', and this is " + here +
                     "; frames are made by one version");
}

// Returns the path by which the processes of a farm call domefall.  It is what --program says, or
// else this program itself.  A name without a folder is looked up in PATH.  A named program is
// asked for its version.  Throws InputError for a name that PATH does not have, for a program that
// is here and cannot be run, and for another version.  A path at which there is nothing here may
// exist on the nodes.  It gets a warning on standard error, or is refused if it is `needed_here`.
std::string farm_program(const std::string& named, bool needed_here) {
  if (named.empty()) return this_program().string();
  const bool has_folder = named.find('/') != std::string::npos;
  const fs::path program =
      fs::absolute(has_folder ? fs::path(named) : found_in_path(named)).lexically_normal();
  std::error_code error;
  if (fs::exists(program, error) || needed_here)
    check_version(program);
  else
    say("warning: --program " + program.string() + ": is not here; it must be on the nodes");
  return program.string();
}

// ---- movie and delivery ----

// Returns the path as the nodes find it, whose working folder may be another.
std::string absolute_path(const std::string& path) {
  return fs::absolute(path).lexically_normal().string();
}

void add_files(std::vector<std::string>& options, const char* name,
               const std::vector<std::string>& files) {
  if (files.empty()) return;
  options.emplace_back(name);
  for (const std::string& file : files) options.push_back(absolute_path(file));
}

void refuse_parts_of_nothing(const FarmProducts& products) {
  if (!products.audio.empty() && products.movie.empty() && products.deliver.empty())
    throw InputError("--audio " + products.audio.front() +
                     ": is the sound of --movie and --deliver, and neither is asked for");
  if (!products.deliver.empty()) return;
  const auto refuse = [](const std::string& option) {
    throw InputError(option + ": is of --deliver, which is not asked for");
  };
  if (!products.subtitles.empty()) refuse("--subtitles " + products.subtitles.front());
  if (products.depth > 0) refuse(fmt::format("--depth {}", products.depth));
  if (products.leader) refuse("--leader");
}

void require_graded(const Show& show, const char* option) {
  if (!show.output.graded)
    throw InputError(fmt::format("{}: {} needs graded frames, and the show makes none",
                                 show.file.string(), option));
}

void add_movie_product(FarmPlan& plan, const FarmProducts& products, const Show& show,
                       const std::vector<int>& frames, const Sound& sound) {
  const MoviePreset& preset = movie_preset(products.movie);
  plan.movie = products.movie;
  plan.movie_file = (plan.out / fmt::format("{}_{}.{}", show.file.stem().string(), products.movie,
                                            preset.extension))
                        .string();
  require_graded(show, "--movie");
  if (std::error_code none; fs::is_directory(plan.movie_file, none))
    throw InputError(plan.movie_file + ": is a folder, where --movie would write its file");
  require_writable(plan.movie_file);
  plan_movie(preset, show, frames, sound, plan.movie_file);
  add_files(plan.movie_options, "--audio", products.audio);
}

void add_delivery(FarmPlan& plan, const FarmProducts& products, const Show& show,
                  const std::vector<int>& frames, const Sound& sound) {
  if (static_cast<int>(frames.size()) != frame_count(show))
    throw InputError("--deliver " + products.deliver + ": takes all frames of the show");
  require_graded(show, "--deliver");
  plan.deliver = absolute_path(products.deliver);
  DeliveryRun run{.show = show,
                  .from = plan.out,
                  .out = plan.deliver,
                  .bits = std::nullopt,
                  .name = {},
                  .sound = sound,
                  .subtitles = {products.subtitles.begin(), products.subtitles.end()},
                  .leader = products.leader};
  if (products.depth > 0) run.bits = products.depth;
  check_delivery_folder(run);
  std::vector<std::string>& options = plan.deliver_options;
  if (products.depth > 0)
    options.insert(options.end(), {"--depth", fmt::to_string(products.depth)});
  if (products.leader) options.emplace_back("--leader");
  add_files(options, "--audio", products.audio);
  add_files(options, "--subtitles", products.subtitles);
}

void add_products(FarmPlan& plan, const FarmProducts& products, const Show& show,
                  const std::vector<int>& frames) {
  refuse_parts_of_nothing(products);
  if (products.movie.empty() && products.deliver.empty()) return;
  const Sound sound = show_sound(show, products.audio);
  if (!products.movie.empty()) add_movie_product(plan, products, show, frames, sound);
  if (!products.deliver.empty()) add_delivery(plan, products, show, frames, sound);
}

// ---- the plan ----

FarmPlan make_plan(const SubmitOptions& o) {
  const Show show = read_show(o.show, o.size, o.overlays);
  const std::vector<int> frames = parse_frames(o.frames, frame_count(show));
  const bool local = engine_named(o.engine).is_local;
  FarmPlan plan;
  plan.id = o.dry ? "PLAN" : new_plan_id();
  plan.version = "domefall " DOMEFALL_VERSION;
  plan.program = farm_program(o.program, local);
  plan.show = fs::absolute(o.show).lexically_normal();
  plan.out = fs::absolute(frames_folder(show, o.out)).lexically_normal();
  // The plan does not list all frames, so that it stays one of all frames when the show changes
  // length.
  if (!o.frames.empty()) plan.frames = as_ranges(frames);
  if (!o.size.empty()) plan.options = {"--size", o.size};
  if (!o.overlays.empty()) plan.options.insert(plan.options.end(), {"--overlay", o.overlays});
  if (o.replace) plan.options.emplace_back("--replace");
  plan.engine = o.engine;
  plan.engine_options = o.engine_options;
  constexpr int kTaskThreads = 4;
  const int processors = all_threads(0);
  plan.threads = o.threads > 0 ? o.threads : local ? processors : kTaskThreads;
  plan.at_once = local ? (o.workers > 0 ? o.workers : std::max(1, processors / 4)) : o.at_once;
  plan.retries = o.retries;
  plan.most_rounds = o.rounds;
  add_products(plan, o.products, show, frames);
  check_plan_text(plan);
  const FrameRun run{show, frames, plan.out, 0, false, true, o.replace, true};
  add_chunks(plan, {o.chunk, o.dry}, show, frames_to_make(run));
  return plan;
}

// Hands the plan to its engine, whose tasks may begin to read it at once.
void hand_over(const FarmPlan& plan, bool wait) {
  write_plan(plan);
  try {
    if (engine_of(plan).conclude && !wait)
      fmt::print("{}\n", submit_round(plan, 0));
    else if (const int signal = run_rounds(plan); signal != 0)
      throw Interrupted{signal};
  } catch (const InputError&) {
    drop_unaccepted_plan(plan);
    throw;
  }
}

}  // namespace

void submit(const SubmitOptions& o) {
  const Engine& engine = engine_named(o.engine);
  if (!engine.takes_options && !o.engine_options.empty())
    throw InputError(o.engine_options.front() + ": only --engine slurm takes options after --");
  if (!o.engine_options.empty() && !o.engine_options.front().starts_with('-'))
    throw InputError(o.engine_options.front() + ": options of sbatch follow --");
  if (!engine.makes_products && !(o.products.movie.empty() && o.products.deliver.empty()))
    throw InputError("--engine " + o.engine +
                     ": its lines make frames only, in any order; run domefall movie or domefall "
                     "deliver when they have ended, without --movie and --deliver here");
  FarmPlan plan = make_plan(o);
  // What an engine cannot take is refused before anything is made.
  const std::string text = engine.text(plan);
  if (o.dry) {
    fmt::print("{}", text);
    return;
  }
  stop_if_interrupted();
  if (engine.has_rounds()) return hand_over(plan, o.wait);
  plan.rounds = {{0, {}, utc_now()}};
  write_plan(plan);
  fmt::print("{}", text);
}

}  // namespace domefall
