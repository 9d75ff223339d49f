#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <list>
#include <memory>
#include <vector>

#include "farm/commands.h"
#include "farm/engine.h"
#include "farm/signal_inbox.h"
#include "farm/worker_process.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"

namespace domefall {
namespace {

using FarmClock = std::chrono::steady_clock;

constexpr int kLongestPauseS = 30, kRetryCode = 75, kRefusedCode = 2;

int pause_after(int tries) { return std::min(kLongestPauseS, 1 << std::min(tries - 1, 5)); }

struct LocalChunk {
  PlannedChunk chunk;
  int tries = 0;
  FarmClock::time_point not_before = FarmClock::now();

  std::string name() const { return "frames " + chunk.frames; }
};

struct LocalTask {
  LocalChunk chunk;
  int slot;
  std::unique_ptr<Descriptor> log;
  std::unique_ptr<WorkerProcess> process;
};

class LocalRun {
 public:
  LocalRun(const FarmPlan& plan, int round, SignalInbox& inbox) : plan_(plan), inbox_(inbox) {
    for (const PlannedChunk& chunk : chunks_of_round(plan, round)) waiting_.push_back({chunk});
    total_ = waiting_.size();
  }

  RoundOutcome run() {
    while (!running_.empty() || (!is_ending() && !waiting_.empty())) {
      pass_signals_on();
      conclude_ended();
      while (is_time_to_start() && start_one()) {
      }
      std::vector<int> talks;
      for (const LocalTask& task : running_) talks.push_back(task.process->talk());
      constexpr double kLookEveryS = 0.2;  // at chunks whose pause is over, and at what is away
      if (!running_.empty() || !waiting_.empty()) inbox_.wait(kLookEveryS, talks);
    }
    outcome_.given_up += static_cast<int>(waiting_.size());
    return outcome_;
  }

 private:
  bool is_ending() const { return outcome_.signal != 0 || outcome_.away || outcome_.refused; }

  void pass_signals_on() {
    for (const int signal : inbox_.take()) {
      if (signal == SIGUSR1) continue;
      if (outcome_.signal == 0)
        say(signal_name(signal) + ": the workers finish their frames; once more ends them at once");
      outcome_.signal = outcome_.signal != 0 ? outcome_.signal : signal;
      for (const LocalTask& task : running_) task.process->tell(signal);
    }
  }

  void conclude_ended() {
    for (auto task = running_.begin(); task != running_.end();) {
      const auto end = task->process->look();
      if (!end) {
        task->process->handle_stop(task->chunk.name());
        ++task;
        continue;
      }
      const LocalTask ended = std::move(*task);
      task = running_.erase(task);
      conclude(ended, *end);
    }
  }

  void conclude(const LocalTask& task, const WorkerEnd& end) {
    const LocalChunk& chunk = task.chunk;
    const std::string last = task.process->last_line();
    if (end.signal == 0 && end.code == 0) {
      say(fmt::format("[{}/{}] {}: {}", ++done_, total_, chunk.name(), last));
      return;
    }
    if (is_ending()) {
      ++outcome_.given_up;
      return;
    }
    say(end.signal != 0 || last.empty() ? chunk.name() + ": " + end.text() : last);
    if (end.signal != 0 || end.code == kRetryCode || end.code > 128) return retry(chunk);
    if (end.code == kRefusedCode) {
      if (!is_refused_here()) return retry(chunk);
      outcome_.refused = true;
      for (const LocalTask& other : running_) other.process->tell(SIGTERM);
      return;
    }
    outcome_.failed = true;
    ++outcome_.given_up;
  }

  // Only the one who submits may say that the input is wrong.
  bool is_refused_here() const {
    Words command = render_command(plan_, plan_.frames, 1);
    command.emplace_back("--dry-run");
    std::string said;
    const WorkerEnd end = run_program(command, said);
    return missing_path(plan_).empty() && end.signal == 0 && end.code == kRefusedCode;
  }

  void retry(LocalChunk chunk) {
    if (chunk.tries > plan_.retries) {
      say(fmt::format("{}: given up after {} tries", chunk.name(), chunk.tries));
      ++outcome_.given_up;
      return;
    }
    const int pause = pause_after(chunk.tries);
    say(fmt::format("{}: next try in {} s", chunk.name(), pause));
    chunk.not_before = FarmClock::now() + std::chrono::seconds(pause);
    waiting_.push_back(std::move(chunk));
  }

  // Returns false where the run ends early or all workers are busy, and while the show or the
  // folder is away, because a worker would make another folder where that of the others is to come
  // back.
  bool is_time_to_start() {
    if (is_ending() || waiting_.empty() || running_.size() >= workers()) return false;
    const std::string missing = missing_path(plan_);
    if (missing.empty()) {
      away_since_.reset();
      return true;
    }
    int patience = 0;
    for (int tries = 1; tries <= plan_.retries; ++tries) patience += pause_after(tries);
    if (!away_since_) {
      away_since_ = FarmClock::now();
      say(missing + ": away for now; no chunk is begun until it is back");
    } else if (FarmClock::now() - *away_since_ >= std::chrono::seconds(patience)) {
      say(fmt::format("{}: still away after {} s; given up", missing, patience));
      outcome_.away = true;
    }
    return false;
  }

  bool start_one() {
    const auto now = FarmClock::now();
    const auto ready = std::find_if(waiting_.begin(), waiting_.end(),
                                    [now](const LocalChunk& c) { return c.not_before <= now; });
    if (ready == waiting_.end()) return false;
    LocalChunk chunk = std::move(*ready);
    waiting_.erase(ready);
    ++chunk.tries;
    try {
      const int slot = free_slot();
      const auto log_file =
          farm_log_folder(plan_.out) /
          fmt::format("local_{}_{}_{}.log", plan_.id, chunk.chunk.round, chunk.chunk.task);
      auto log = std::make_unique<Descriptor>(
          open(log_file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
      auto process = std::make_unique<WorkerProcess>(work_command(chunk.chunk, slot),
                                                     WorkerProcess::Way{.log = log->number()});
      running_.push_back({std::move(chunk), slot, std::move(log), std::move(process)});
    } catch (const TemporaryError& error) {
      // There may be too many processes, say.  Those that run go on.
      say(chunk.name() + ": a worker cannot be started: " + error.what());
      retry(chunk);
    }
    return true;
  }

  std::size_t workers() const { return static_cast<std::size_t>(std::max(1, plan_.at_once)); }

  int free_slot() const {
    int slot = 0;
    while (std::any_of(running_.begin(), running_.end(),
                       [slot](const LocalTask& task) { return task.slot == slot; }))
      ++slot;
    return slot;
  }

  std::vector<std::string> work_command(const PlannedChunk& chunk, int slot) const {
    const int count = static_cast<int>(workers());
    const int share = plan_.threads / count + (slot < plan_.threads % count ? 1 : 0);
    return {plan_.program, "farm",
            "work",        plan_.out.string(),
            "--plan",      plan_.id,
            "--round",     fmt::to_string(chunk.round),
            "--task",      fmt::to_string(chunk.task),
            "--threads",   fmt::to_string(std::max(1, share))};
  }

  const FarmPlan& plan_;
  SignalInbox& inbox_;
  std::list<LocalChunk> waiting_;
  std::list<LocalTask> running_;
  std::size_t total_ = 0, done_ = 0;
  std::optional<FarmClock::time_point> away_since_;  // when the show or the folder was first missed
  RoundOutcome outcome_;
};

}  // namespace

RoundOutcome run_locally(const FarmPlan& plan, int round, const std::string&, SignalInbox& inbox) {
  return LocalRun(plan, round, inbox).run();
}

}  // namespace domefall
