#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "pipeline/cli/interruption.h"
#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/farm/farm_task.h"
#include "pipeline/farm/rounds.h"
#include "pipeline/farm/signal_inbox.h"
#include "pipeline/farm/slurm.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kMostRound = 1'000'000;

struct WorkOptions {
  std::string out, plan;
  int round = 0, task = 0, threads = 0;
};

std::string node_name(const SlurmTask& task) {
  if (!task.node.empty()) return task.node;
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

PlannedChunk chunk_of(const FarmPlan& plan, const WorkOptions& o) {
  for (const PlannedChunk& chunk : chunks_of_round(plan, o.round))
    if (chunk.task == o.task) return chunk;
  throw InputError(fmt::format("{}: no task {} in round {}", plan_file(plan.out, plan.id).string(),
                               o.task, o.round));
}

// Reads the plan from a folder that this machine may not see yet.
std::optional<FarmPlan> plan_if_seen(const WorkOptions& o, std::string& why) {
  try {
    return read_plan(o.out, o.plan);
  } catch (const TemporaryError& error) {
    why = std::string("this node does not see the plan: ") + error.what();
    return std::nullopt;
  }
}

// Ends this task as its outcome asks for, with one line that says why.
[[noreturn]] void end_work(const TaskEnd& end, const std::string& where) {
  const std::string line = where + ": " + end.why;
  switch (end.kind) {
    case TaskEnd::Kind::kRefused:
      throw InputError(line);
    case TaskEnd::Kind::kStopped:
      std::fprintf(stderr, "%s\n", line.c_str());
      throw Interrupted{end.signal, true};
    case TaskEnd::Kind::kFailed:
      throw std::runtime_error(line);
    default:
      throw TemporaryError(line);
  }
}

// Ends a task of Slurm.  It goes back into the queue by itself, because nobody but the one who
// submitted it may say that the input is wrong.
[[noreturn]] void end_slurm_work(const TaskEnd& end, const SlurmTask& task, int retries,
                                 const std::string& where, SignalInbox& inbox) {
  using Kind = TaskEnd::Kind;
  if (end.kind == Kind::kStopped || end.kind == Kind::kFailed) end_work(end, where);
  // A cancellation that ended the worker also reaches this process.
  inbox.wait(1);
  for (const int signal : inbox.take())
    if (signal == SIGTERM) end_work({Kind::kStopped, "cancelled", SIGTERM}, where);
  if (task.restarts >= retries)
    throw TemporaryError(
        fmt::format("{}: {}; given up after {} restarts", where, end.why, task.restarts));
  std::fprintf(stderr, "%s: %s; back to the queue (restart %d of at most %d)\n", where.c_str(),
               end.why.c_str(), task.restarts + 1, retries);
  requeue_slurm_task(task, end.kind != Kind::kAgain, inbox);
  throw TemporaryError(where + ": not ended by Slurm after it was put back into the queue");
}

void work(const WorkOptions& o) {
  SignalInbox inbox;
  const bool slurm = is_in_slurm();
  const SlurmTask task = slurm ? this_slurm_task() : SlurmTask{};
  const std::string host = node_name(task);
  std::string why;
  const auto plan = plan_if_seen(o, why);
  TaskEnd end{TaskEnd::Kind::kAgainElsewhere, why};
  std::string where = fmt::format("{}: task {} of round {}", host, o.task, o.round);
  int retries = FarmPlan{}.retries;
  if (plan) {
    const PlannedChunk chunk = chunk_of(*plan, o);
    where = host + ": frames " + chunk.frames;
    retries = plan->retries;
    const int threads = o.threads > 0 ? o.threads : slurm ? task.processors : plan->threads;
    end = run_task(*plan, chunk, {threads, slurm}, inbox);
  }
  if (end.kind == TaskEnd::Kind::kDone) return;
  if (slurm) end_slurm_work(end, task, retries, where, inbox);
  end_work(end, where);
}

// Concludes a round.  In Slurm a folder that is away for a moment does not end the rounds, because
// this job goes back into the queue.
void conclude(const WorkOptions& o) {
  try {
    conclude_round(read_plan(o.out, o.plan), o.round);
  } catch (const FramesLacking&) {
    throw;
  } catch (const TemporaryError& error) {
    if (!is_in_slurm()) throw;
    SignalInbox inbox;
    const SlurmTask task = this_slurm_task();
    end_slurm_work({TaskEnd::Kind::kAgainElsewhere, error.what()}, task, FarmPlan{}.retries,
                   fmt::format("{}: round {}", node_name(task), o.round), inbox);
  }
}

void add_place_options(CLI::App& verb, WorkOptions& o, const char* round) {
  verb.add_option("DIR", o.out, "folder of the frames, which has farm/plan_ID.json")
      ->type_name(kFolderType)
      ->required();
  verb.add_option("--plan", o.plan, "the ID")->required();
  verb.add_option("--round", o.round, round)
      ->check(number_in(0, kMostRound))
      ->capture_default_str();
}

}  // namespace

void add_farm_work(CLI::App& farm) {
  auto* verb =
      farm.add_subcommand("work", "Render one task of a plan; what the jobs of farm submit run");
  auto o = std::make_shared<WorkOptions>();
  add_place_options(*verb, *o, "0: the first submission");
  verb->add_option("--task", o->task, "number of the chunk in its round")
      ->check(number_in(0, kMostRound))
      ->required();
  verb->add_option("--threads", o->threads, "default what Slurm gives, or else what the plan says")
      ->check(number_in(0, 1024));
  verb->callback([o] { work(*o); });
}

void add_farm_conclude(CLI::App& farm) {
  auto* verb = farm.add_subcommand(
      "conclude", "Verify a round's frames; submit what is missing, or make the movie");
  auto o = std::make_shared<WorkOptions>();
  add_place_options(*verb, *o, "the round that has ended");
  verb->callback([o] { conclude(*o); });
}

}  // namespace domefall
