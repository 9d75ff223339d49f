// The engines are what a farm hands the tasks of a plan to.
//
// A further engine is a file of its own, NAME.cpp, and a row in engine.cpp.  Its functions are
// declared below.  One that takes a text needs no more than `text`; what follows the frames is then
// its queue manager's.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "farm/plan.h"

namespace domefall {

class SignalInbox;

// A RoundOutcome is how a round that this process waited for has ended.
struct RoundOutcome {
  int signal = 0;        // that ended the wait early, or 0
  bool away = false;     // the show or the folder went away and stayed away
  bool refused = false;  // a task's input was refused, and so is the show here
  bool failed = false;   // a defect
  int given_up = 0;      // chunks
};

struct Engine {
  std::string_view name, about;  // a word, and what it is for people

  bool is_local = false;       // its tasks are processes of this machine and share its processors
  bool takes_options = false;  // such as sbatch has, after --
  bool makes_products = true;  // movie and delivery

  // Returns how many tasks a round may have at most.  A plan that is only printed needs no answer
  // from a controller.
  int (*most_tasks)(bool only_printed);
  std::string_view limit = "a job of this kind may have";  // whose that is
  std::size_t longest_frames = std::string::npos;          // characters that name a task's frames

  // Returns what the engine is handed, or would be.
  std::string (*text)(const FarmPlan& plan);

  // These are null where another program takes the text.  start() hands the chunks of a round to the
  // engine and returns its job, or an empty text where it has no jobs.  wait() returns when they
  // have ended.
  std::string (*start)(const FarmPlan& plan, int round) = nullptr;
  RoundOutcome (*wait)(const FarmPlan& plan, int round, const std::string& job,
                       SignalInbox& inbox) = nullptr;

  // These are null but where a job can follow another.  conclude() starts the job that verifies the
  // frames when `after` has ended, unless that is empty, and returns it.  Cancelled tasks are not
  // rendered again.
  std::string (*conclude)(const FarmPlan& plan, int round, const std::string& after) = nullptr;
  void (*cancel)(const std::string& job) = nullptr;
  bool (*was_cancelled)(const std::string& job) = nullptr;
  std::string_view cancel_command = {};

  // Says whether this program goes through the rounds, and not another.
  bool has_rounds() const { return wait != nullptr; }
};

std::span<const Engine> engines();

// Throws InputError for a name that no engine has.
const Engine& engine_named(std::string_view name);
inline const Engine& engine_of(const FarmPlan& plan) { return engine_named(plan.engine); }

// Those that write JSON throw InputError for a path that is not UTF-8.

// Returns one command line a chunk, quoted for a shell.
std::string list_of_commands(const FarmPlan& plan);

// Returns an Open Job Description template, version 2023-09, without extensions.  It has a step
// with one task a chunk.  After it follow a step that verifies and repairs, and those for the movie
// and the delivery that the plan asks for.  Throws InputError for a path that holds {{.
// https://github.com/OpenJobDescription/openjd-specifications/wiki/2023-09-Template-Schemas
std::string openjd_template(const FarmPlan& plan);

// Returns a job for Flamenco's job type farm/flamenco/domefall.js, as its manager takes it at
// /api/v3/jobs.
std::string flamenco_job(const FarmPlan& plan);

// Runs the chunks of a round on this machine, each as a process `domefall farm work`, which is what a
// cluster runs, too.  At most plan.at_once run at the same time, each with its share of plan.threads.
// A task that exits with 75, or is killed, is tried again, plan.retries times, after pauses that
// grow.  While the show or the folder is away no task is begun.  The first signal lets the workers
// finish their frames, and a second one ends them at once.
RoundOutcome run_locally(const FarmPlan& plan, int round, const std::string& job,
                         SignalInbox& inbox);

}  // namespace domefall
