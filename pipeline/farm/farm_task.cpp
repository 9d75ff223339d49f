#include "pipeline/farm/farm_task.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <optional>

#include "pipeline/farm/signal_inbox.h"
#include "pipeline/farm/worker_process.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kRefusalsBelieved = 3;  // so many in a row; they take 3 s
constexpr int kRefusedCode = 2, kAgainCode = 75;

class TaskRun {
 public:
  TaskRun(const FarmPlan& plan, const PlannedChunk& chunk, const TaskPlace& place,
          SignalInbox& inbox)
      : plan_(plan), chunk_(chunk), place_(place), inbox_(inbox) {}

  TaskEnd run() {
    for (int refusals = 0;;) {
      if (const auto end = unfit_node()) return *end;
      const auto ended = render();
      if (!ended) return {TaskEnd::Kind::kAgainElsewhere, cannot_start_};
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
      return TaskEnd{TaskEnd::Kind::kAgainElsewhere, "this node does not see " + missing};
    const std::string here = "domefall " DOMEFALL_VERSION;
    if (here != plan_.version)
      return TaskEnd{TaskEnd::Kind::kAgainElsewhere,
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
        worker.mind_stops("frames " + chunk_.frames);
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
    if (time_is_up_) return {Kind::kAgain, "the time limit is near"};
    const std::string why = said_.empty() ? end.text() : end.text() + ": " + said_;
    if (end.signal != 0) return {Kind::kAgain, end.text()};
    // Somebody else has asked the worker to end.
    if (end.code > 128 && end.code <= 128 + 64)
      return {Kind::kAgain, "stopped by " + signal_name(end.code - 128)};
    if (end.code == kAgainCode) return {Kind::kAgainElsewhere, why};
    if (end.code == kRefusedCode) {
      const std::string missing = missing_path(plan_);
      if (missing.empty()) return {Kind::kRefused, why};
      return {Kind::kAgainElsewhere, "this node does not see " + missing};
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

}  // namespace

TaskEnd run_task(const FarmPlan& plan, const PlannedChunk& chunk, const TaskPlace& place,
                 SignalInbox& inbox) {
  return TaskRun(plan, chunk, place, inbox).run();
}

std::vector<std::string> render_command(const FarmPlan& plan, const std::string& frames,
                                        int threads) {
  std::vector<std::string> command{plan.program,      "render",    plan.show.string(),
                                   "--frames",        frames,      "--out",
                                   plan.out.string(), "--threads", fmt::to_string(threads)};
  command.insert(command.end(), plan.options.begin(), plan.options.end());
  return command;
}

std::string missing_path(const FarmPlan& plan) {
  if (access(plan.show.c_str(), R_OK) != 0) return plan.show.string();
  std::error_code error;
  if (!std::filesystem::is_directory(plan.out, error)) return plan.out.string();
  return {};
}

}  // namespace domefall
