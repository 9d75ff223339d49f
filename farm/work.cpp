#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <optional>
#include <stdexcept>

#include "farm/commands.h"
#include "farm/plan.h"
#include "farm/rounds.h"
#include "farm/signal_inbox.h"
#include "farm/slurm.h"
#include "farm/verbs.h"
#include "farm/worker_process.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/talk.h"

namespace domefall {
namespace {

// A TaskEnd says what came of a chunk.
struct TaskEnd {
  enum class Kind {
    kDone,
    kFailed,   // a defect, such as a pixel that is no number; another try fails, too
    kRefused,  // the input was refused three times in a row; it was good where it was submitted
    kRetry,    // worth another try anywhere: the worker was killed, or time is up
    kRetryElsewhere,  // worth another try, and better on another machine
    kStopped          // by a signal, which asked for no other try
  };
  Kind kind = Kind::kDone;
  std::string why;  // one line
  int signal = 0;   // of kStopped
};

struct TaskPlace {
  int threads = 1;
  // This says whether a manager signals the worker itself.  Then no signal but USR1 is passed on,
  // since a second TERM would end the worker in the middle of its frame.
  bool signals_reach_worker = false;
};

constexpr int kRefusalsBelieved = 3;  // so many in a row; they take 3 s
constexpr int kRefusedCode = 2, kRetryCode = 75;

class TaskRun {
 public:
  TaskRun(const FarmPlan& plan, const PlannedChunk& chunk, const TaskPlace& place,
          SignalInbox& inbox)
      : plan_(plan), chunk_(chunk), place_(place), inbox_(inbox) {}

  TaskEnd run() {
    for (int refusals = 0;;) {
      if (const auto end = unfit_node()) return *end;
      const auto ended = render();
      if (!ended) return {TaskEnd::Kind::kRetryElsewhere, cannot_start_};
      const bool refused = ended->signal == 0 && ended->code == kRefusedCode;
      if (!refused || stopped_ != 0 || time_is_up_) return verdict(*ended);
      if (++refusals == kRefusalsBelieved) return verdict(*ended);
      // The show was good when it was submitted.  It may just have been away, or be half written.
      pause(refusals);
      if (stopped_ != 0 || time_is_up_) return verdict(*ended);
    }
  }

 private:
  // Returns why this machine cannot make frames of the plan, or nothing if it can.
  std::optional<TaskEnd> unfit_node() const {
    if (const std::string missing = missing_path(plan_); !missing.empty())
      return TaskEnd{TaskEnd::Kind::kRetryElsewhere, "this node does not see " + missing};
    const std::string here = "domefall " DOMEFALL_VERSION;
    if (here != plan_.version)
      return TaskEnd{TaskEnd::Kind::kRetryElsewhere,
                     fmt::format("this node has {}, not {}", here, plan_.version)};
    return std::nullopt;
  }

  // Returns how the worker ended, or nothing if it could not be started.
  std::optional<WorkerEnd> render() {
    try {
      WorkerProcess worker(render_command(plan_, chunk_.frames, place_.threads),
                           {.log = STDERR_FILENO, .own_session = !place_.signals_reach_worker});
      for (;;) {
        heed(&worker);
        if (const auto end = worker.look()) {
          said_ = worker.last_line();
          return end;
        }
        worker.handle_stop("frames " + chunk_.frames);
        inbox_.wait(1, {worker.talk()});
      }
    } catch (const TemporaryError& error) {
      cannot_start_ = std::string("a worker cannot be started: ") + error.what();
      return std::nullopt;
    }
  }

  void heed(const WorkerProcess* worker) {
    for (const int signal : inbox_.take()) {
      if (signal == SIGUSR1)
        time_is_up_ = true;
      else
        stopped_ = signal;
      const bool pass_on = signal == SIGUSR1 || !place_.signals_reach_worker;
      if (worker && pass_on) worker->tell(signal == SIGUSR1 ? SIGTERM : signal);
    }
  }

  void pause(int seconds) {
    constexpr double kStepS = 0.1;
    for (double left = seconds; left > 0 && stopped_ == 0 && !time_is_up_; left -= kStepS) {
      inbox_.wait(kStepS);
      heed(nullptr);
    }
  }

  TaskEnd verdict(const WorkerEnd& end) const {
    using Kind = TaskEnd::Kind;
    if (end.signal == 0 && end.code == 0) return {Kind::kDone, said_};
    if (stopped_ != 0) return {Kind::kStopped, "stopped by " + signal_name(stopped_), stopped_};
    if (time_is_up_) return {Kind::kRetry, "the time limit is near"};
    const std::string why = said_.empty() ? end.text() : end.text() + ": " + said_;
    if (end.signal != 0) return {Kind::kRetry, end.text()};
    // Somebody else has asked the worker to end.
    if (end.code > 128 && end.code <= 128 + 64)
      return {Kind::kRetry, "stopped by " + signal_name(end.code - 128)};
    if (end.code == kRetryCode) return {Kind::kRetryElsewhere, why};
    if (end.code == kRefusedCode) {
      const std::string missing = missing_path(plan_);
      if (missing.empty()) return {Kind::kRefused, why};
      return {Kind::kRetryElsewhere, "this node does not see " + missing};
    }
    return {Kind::kFailed, why};
  }

  const FarmPlan& plan_;
  const PlannedChunk& chunk_;
  const TaskPlace& place_;
  SignalInbox& inbox_;
  int stopped_ = 0;
  bool time_is_up_ = false;
  std::string said_, cannot_start_;
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
      say(line);
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
  say(fmt::format("{}: {}; back to the queue (restart {} of at most {})", where, end.why,
                  task.restarts + 1, retries));
  requeue_slurm_task(task, end.kind != Kind::kRetry, inbox);
  throw TemporaryError(where + ": not ended by Slurm after it was put back into the queue");
}

}  // namespace

void work_on_task(const WorkOptions& o) {
  SignalInbox inbox;
  const SlurmTask task = o.slurm ? this_slurm_task(true) : SlurmTask{};
  const std::string host = node_name(task);
  std::string why;
  const auto plan = plan_if_seen(o, why);
  TaskEnd end{TaskEnd::Kind::kRetryElsewhere, why};
  std::string where = fmt::format("{}: task {} of round {}", host, o.task, o.round);
  int retries = FarmPlan{}.retries;
  if (plan) {
    const PlannedChunk chunk = chunk_of(*plan, o);
    where = host + ": frames " + chunk.frames;
    retries = plan->retries;
    const int threads = o.threads > 0 ? o.threads : o.slurm ? task.processors : plan->threads;
    end = TaskRun(*plan, chunk, {threads, o.slurm}, inbox).run();
  }
  if (end.kind == TaskEnd::Kind::kDone) return;
  if (o.slurm) end_slurm_work(end, task, retries, where, inbox);
  end_work(end, where);
}

void conclude_job(const WorkOptions& o) {
  const SlurmTask task = o.slurm ? this_slurm_task(false) : SlurmTask{};
  try {
    conclude_round(read_plan(o.out, o.plan), o.round, task.id);
  } catch (const FramesLacking&) {
    throw;
  } catch (const TemporaryError& error) {
    if (!o.slurm) throw;
    SignalInbox inbox;
    end_slurm_work({TaskEnd::Kind::kRetryElsewhere, error.what()}, task, FarmPlan{}.retries,
                   fmt::format("{}: round {}", node_name(task), o.round), inbox);
  }
}

}  // namespace domefall
