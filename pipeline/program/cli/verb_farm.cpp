#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "farm/engine.h"
#include "farm/verbs.h"
#include "pipeline/base/interruption.h"
#include "pipeline/program/cli/number_in.h"
#include "pipeline/program/cli/option_types.h"
#include "pipeline/program/cli/verbs.h"
#include "pipeline/theatre/movie/preset.h"

namespace domefall {
namespace {

constexpr int kMostRound = 1'000'000;

void add_farm_options(CLI::App& verb, FarmRequest& request) {
  add_folder(verb, "DIR", request.folder, "folder of the frames")->required();
  add_file(verb, "--show", request.show, "show file (YAML); default as planned");
  verb.add_option("--plan", request.plan, "ID of DIR/farm/plan_ID.json; default the latest");
  verb.add_option("--frames", request.frames,
                  "such as 7, 0-299 or 3-5,9; default as planned, or all")
      ->type_name("FRAMES");
  verb.add_option("--size", request.size, "of the frames; default as planned, or the show's")
      ->type_name("SIZE");
  add_overlay_option(verb, request.overlays);
  verb.add_option("--threads", request.threads, "0: four, or one per processor")
      ->check(number_in(0, 1024));
}

struct StatusOptions {
  FarmRequest request;
  bool json = false, watch = false;
};

// Returns a page, or JSON.  An object takes one line where others will follow it.
std::string status_text(const StatusOptions& o, const FarmFrames& frames,
                        const FarmStatus& status) {
  constexpr int kIndent = 2, kOneLine = -1;
  if (o.json) return farm_json(frames, status, o.watch ? kOneLine : kIndent) + "\n";
  return farm_page(frames, status);
}

// Says the status anew every two seconds until all is done.  On a terminal it replaces the text
// before, and elsewhere it follows that.  A signal is the way in which this is meant to end.
void watch_folder(const StatusOptions& o) {
  constexpr std::chrono::milliseconds kPause(2000), kStep(50);
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  for (;;) {
    // The show may have been changed meanwhile, and the plan has a new round now and then.
    const FarmFrames frames(o.request);
    const FarmStatus status = farm_status(frames, reading_threads(o.request));
    if (terminal && !o.json) fmt::print("\x1b[H\x1b[J");
    fmt::print("{}", status_text(o, frames, status));
    std::fflush(stdout);
    if (is_complete(status) || std::ferror(stdout)) return;
    for (std::chrono::milliseconds waited(0); waited < kPause; waited += kStep) {
      stop_if_interrupted();
      std::this_thread::sleep_for(kStep);
    }
  }
}

void show_status(const StatusOptions& o) {
  catch_interruptions();
  if (!o.watch) {
    const FarmFrames frames(o.request);
    fmt::print("{}", status_text(o, frames, farm_status(frames, reading_threads(o.request))));
    return;
  }
  try {
    watch_folder(o);
  } catch (Interrupted& stop) {
    stop.expected = true;
    throw;
  }
}

void add_status(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "status", "How far a show's frames are, by their names, beginnings and manifests");
  auto o = std::make_shared<StatusOptions>();
  add_farm_options(*verb, o->request);
  verb->add_flag("--json", o->json, "print it as JSON; with --watch one object a line");
  verb->add_flag("--watch", o->watch, "say it again every two seconds until all frames are done");
  verb->callback([o] { show_status(*o); });
}

void add_verify(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "verify", "Read every byte of a show's frames; ends with 1 where not all are there and good");
  struct Options {
    FarmRequest request;
    bool json = false, repair = false;
  };
  auto o = std::make_shared<Options>();
  add_farm_options(*verb, o->request);
  verb->add_flag("--json", o->json, "print what was found as JSON");
  verb->add_flag("--repair", o->repair, "make the frames again that are not good");
  verb->callback([o] { verify_folder(o->request, o->json, o->repair); });
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
  add_number(verb, "--retries", o->retries, "how often a task is tried again", 0, kMostTries);
  add_number(verb, "--rounds", o->rounds,
             "how often what is missing or bad after all tasks is rendered again", 0, kMostTries);
  add_file(verb, "--program", o->program,
           "where the nodes find domefall, or its name in PATH; default this program")
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
  add_folder(verb, "--deliver", products.deliver, "then make this folder for delivery")
      ->check(refuse_empty);
  add_file(verb, "--audio", products.audio,
           std::string("of the movie and of the delivery: ") + kAudioHelp);
  verb.add_option("--depth", products.depth, "of the delivery: 8 or 16 bits a colour")
      ->check(CLI::IsMember({8, 16}));
  add_file(verb, "--subtitles", products.subtitles, "of the delivery: SubRip files (.srt)");
  verb.add_flag("--leader", products.leader, "of the delivery: slate and countdown");
}

void add_submit(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "submit", "Render a show by many processes: here, on Slurm, or for another queue manager");
  auto o = std::make_shared<SubmitOptions>();
  add_show(*verb, o->show)->required();
  std::vector<std::string> names, meanings;
  for (const Engine& engine : engines()) {
    names.emplace_back(engine.name);
    meanings.push_back(fmt::format("{}: {}", engine.name, engine.about));
  }
  verb->add_option("--engine", o->engine, fmt::format("{}", fmt::join(meanings, "; ")))
      ->check(CLI::IsMember(names))
      ->required();
  add_folder(*verb, "--out", o->out, "folder of the frames; default out/NAME")->check(refuse_empty);
  verb->add_option("--frames", o->frames, "as of render; default all")->type_name("FRAMES");
  verb->add_option("--size", o->size, "as of render; default the show's")->type_name("SIZE");
  add_overlay_option(*verb, o->overlays);
  verb->add_flag("--replace", o->replace, "as of render");
  add_product_options(*verb, o);
  add_how_options(*verb, o);
  verb->callback([o] { submit(*o); });
}

void add_place_options(CLI::App& verb, WorkOptions& o, const char* round) {
  add_folder(verb, "DIR", o.out, "folder of the frames, which has farm/plan_ID.json")->required();
  verb.add_option("--plan", o.plan, "the ID")->required();
  add_number(verb, "--round", o.round, round, 0, kMostRound);
  verb.add_flag("--slurm", o.slurm,
                "this is a job of Slurm that farm submit has made, and may be requeued");
}

void add_work(CLI::App& farm) {
  auto* verb =
      farm.add_subcommand("work", "Render one task of a plan; what the jobs of farm submit run");
  auto o = std::make_shared<WorkOptions>();
  add_place_options(*verb, *o, "0: the first submission");
  verb->add_option("--task", o->task, "number of the chunk in its round")
      ->check(number_in(0, kMostRound))
      ->required();
  verb->add_option("--threads", o->threads, "default what Slurm gives, or else what the plan says")
      ->check(number_in(0, 1024));
  verb->callback([o] { work_on_task(*o); });
}

void add_conclude(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "conclude", "Verify a round's frames; submit what is missing, or make the movie");
  auto o = std::make_shared<WorkOptions>();
  add_place_options(*verb, *o, "the round that has ended");
  verb->callback([o] { conclude_job(*o); });
}

}  // namespace

void add_farm(CLI::App& app) {
  CLI::App* farm = app.add_subcommand("farm", "Render a show on many machines, and verify it");
  farm->require_subcommand(1);
  add_submit(*farm);
  add_status(*farm);
  add_verify(*farm);
  add_work(*farm);
  add_conclude(*farm);
}

}  // namespace domefall
