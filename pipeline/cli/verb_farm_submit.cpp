#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "pipeline/cli/farm_submission.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/overlay_option.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/farm/job_lists.h"
#include "pipeline/farm/rounds.h"
#include "pipeline/farm/shell_words.h"
#include "pipeline/farm/slurm.h"
#include "pipeline/image/errors.h"
#include "pipeline/movie/preset.h"

namespace domefall {
namespace {

// Returns what a submission would hand to the engine.
std::string text_for_engine(const FarmPlan& plan) {
  if (plan.engine == "openjd") return openjd_template(plan);
  if (plan.engine == "flamenco") return flamenco_job(plan);
  if (plan.engine != "slurm") return list_of_commands(plan);
  const std::string array =
      plan.chunks.empty() ? std::string() : shell_line(array_submission(plan, 0)) + "\n";
  // The array's id is known only when it is submitted.
  return array + shell_line(conclusion_submission(plan, 0, plan.chunks.empty() ? "" : "JOB")) +
         "\n";
}

// Hands the plan to its engine, whose tasks may begin to read it at once.
void hand_over(const FarmPlan& plan, bool wait) {
  write_plan(plan);
  try {
    if (plan.engine == "slurm" && !wait)
      fmt::print("{}\n", submit_round(plan, 0));
    else if (const int signal = run_rounds(plan); signal != 0)
      throw Interrupted{signal};
  } catch (const InputError&) {
    drop_unaccepted_plan(plan);
    throw;
  }
}

void submit(const SubmitOptions& o) {
  if (o.engine != "slurm" && !o.engine_options.empty())
    throw InputError(o.engine_options.front() + ": only --engine slurm takes options after --");
  if (!o.engine_options.empty() && !o.engine_options.front().starts_with('-'))
    throw InputError(o.engine_options.front() + ": options of sbatch follow --");
  if (o.engine == "list" && !(o.products.movie.empty() && o.products.deliver.empty()))
    throw InputError(
        "--engine list: its lines make frames only, in any order; run domefall movie or domefall "
        "deliver when they have ended, without --movie and --deliver here");
  FarmPlan plan = make_plan(o);
  if (o.dry) {
    fmt::print("{}", text_for_engine(plan));
    return;
  }
  stop_if_interrupted();
  if (o.engine == "local" || o.engine == "slurm") return hand_over(plan, o.wait);
  const std::string text = text_for_engine(plan);
  plan.rounds = {{0, {}, utc_now()}};
  write_plan(plan);
  fmt::print("{}", text);
}

void add_how_options(CLI::App& verb, const std::shared_ptr<SubmitOptions>& o) {
  constexpr int kMostWorkers = 1024, kMostTries = 1000, kMostChunkFrames = 10'000'000;
  verb.add_option("--workers", o->workers,
                  "with local: processes at once; default one for every four processors")
      ->check(number_in(1, kMostWorkers));
  verb.add_option("--threads", o->threads,
                  "of a task, which asks for as many processors; default 4.  With local: of all "
                  "workers together; default one per processor")
      ->check(number_in(1, kMostWorkers));
  verb.add_option("--chunk", o->chunk,
                  "frames of a task; default as many as take equal time, some minutes each")
      ->check(number_in(1, kMostChunkFrames));
  verb.add_option("--at-once", o->at_once, "with slurm: tasks that may run at the same time")
      ->check(number_in(1, kMostChunkFrames));
  verb.add_option("--retries", o->retries, "how often a task is tried again")
      ->check(number_in(0, kMostTries))
      ->capture_default_str();
  verb.add_option("--rounds", o->rounds,
                  "how often what is missing or bad after all tasks is rendered again")
      ->check(number_in(0, kMostTries))
      ->capture_default_str();
  verb.add_option("--program", o->program,
                  "where the nodes find domefall, or its name in PATH; default this program")
      ->type_name(kFileType)
      ->check(refuse_empty);
  verb.add_flag("--wait", o->wait, "with slurm: end when all frames are good");
  verb.add_flag("--dry-run", o->dry, "only print what would be submitted");
  verb.add_option("engine_options", o->engine_options,
                  "after --: options of sbatch, such as --partition=render --time=4:00:00");
}

void add_product_options(CLI::App& verb, const std::shared_ptr<SubmitOptions>& o) {
  std::vector<std::string_view> presets;
  for (const MoviePreset& preset : movie_presets()) presets.push_back(preset.name);
  FarmProducts& products = o->products;
  verb.add_option("--movie", products.movie,
                  "then make a movie of this preset, DIR/NAME_PRESET.mp4, .mov or .mkv")
      ->type_name(one_of(presets));
  verb.add_option("--deliver", products.deliver, "then make this folder for delivery")
      ->type_name(kFolderType)
      ->check(refuse_empty);
  verb.add_option("--audio", products.audio, "of the movie and of the delivery, as these take it")
      ->type_name(kFileType);
  verb.add_option("--depth", products.depth, "of the delivery: 8 or 16 bits a colour")
      ->check(CLI::IsMember({8, 16}));
  verb.add_option("--subtitles", products.subtitles, "of the delivery: SubRip files (.srt)")
      ->type_name(kFileType);
  verb.add_flag("--leader", products.leader, "of the delivery: slate and countdown");
}

}  // namespace

void add_farm_submit(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "submit", "Render a show by many processes: here, on Slurm, or for another queue manager");
  auto o = std::make_shared<SubmitOptions>();
  add_show(*verb, o->show)->required();
  verb->add_option("--engine", o->engine,
                   "slurm: a job array, verified and completed; local: processes on this machine; "
                   "list: a command line a task; openjd: an Open Job Description template; "
                   "flamenco: a job of farm/flamenco/domefall.js")
      ->check(CLI::IsMember({"slurm", "local", "list", "openjd", "flamenco"}))
      ->required();
  verb->add_option("--out", o->out, "folder of the frames; default out/NAME")
      ->type_name(kFolderType)
      ->check(refuse_empty);
  verb->add_option("--frames", o->frames, "as of render; default all")->type_name("FRAMES");
  verb->add_option("--size", o->size, "as of render; default the show's")->type_name("SIZE");
  add_overlay_option(*verb, o->overlays);
  verb->add_flag("--replace", o->replace, "as of render");
  add_product_options(*verb, o);
  add_how_options(*verb, o);
  verb->callback([o] { submit(*o); });
}

}  // namespace domefall
