#include "pipeline/farm/rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "pipeline/farm/conclusion_note.h"
#include "pipeline/farm/finish.h"
#include "pipeline/farm/local_engine.h"
#include "pipeline/farm/signal_inbox.h"
#include "pipeline/farm/slurm.h"
#include "pipeline/farm/slurm_cancellation.h"
#include "pipeline/farm/worker_process.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

constexpr int kMostLocalChunks = 10000;

void announce(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

int most_chunks(const FarmPlan& plan) {
  return plan.engine == "slurm" ? most_array_tasks() : kMostLocalChunks;
}

void note_round(FarmPlan& plan, int round, const std::string& job) {
  const auto at = std::find_if(plan.rounds.begin(), plan.rounds.end(),
                               [round](const FarmRound& r) { return r.round == round; });
  if (at == plan.rounds.end())
    plan.rounds.push_back({round, job, utc_now()});
  else
    at->job = job;
  write_plan(plan);
}

std::string missing_text(const FarmPlan& plan, const FramesVerdict& verdict) {
  return fmt::format(
      "missing, damaged or of another version: frames {} ({} of {}); the logs are in {}",
      verdict.to_make, verdict.to_make_count, verdict.frames, farm_log_folder(plan.out).string());
}

void finish_plan(const FarmPlan& plan, const FramesVerdict& verdict) {
  announce(fmt::format("all {} frames are there: {}", verdict.frames, plan.out.string()));
  make_movie_and_delivery(plan);
}

FarmPlan next_round(const FarmPlan& plan, const FramesVerdict& verdict) {
  FarmPlan next = with_round(plan, verdict, most_chunks(plan));
  announce(fmt::format("round {} of at most {}: frames {} ({} of {}) are rendered again",
                       next.rounds.back().round, plan.most_rounds, verdict.to_make,
                       verdict.to_make_count, verdict.frames));
  return next;
}

// Throws where somebody has cancelled the tasks of a round, since then they are not rendered again.
void stop_if_cancelled(const FarmPlan& plan, int round) {
  if (plan.engine != "slurm") return;
  for (const FarmRound& one : plan.rounds)
    if (one.round == round && !one.job.empty() && slurm_job_was_cancelled(one.job))
      throw FramesLacking("job " + one.job + " was cancelled, so that nothing more is made in " +
                          plan.out.string() + "; the same submission goes on with what is left");
}

// Waits for a job array, however long the controller may be away.
int wait_for_slurm(const std::string& job, SignalInbox& inbox) {
  constexpr double kFirstPauseS = 0.5, kLongestPauseS = 10;
  for (double pause = kFirstPauseS;; pause = std::min(kLongestPauseS, 1.3 * pause)) {
    if (slurm_job_is_over(job)) return 0;
    inbox.wait(pause);
    for (const int signal : inbox.take())
      if (signal != SIGUSR1) {
        announce("job " + job +
                 " goes on without this program; domefall farm status tells how far");
        return signal;
      }
  }
}

// Renders the chunks of a round and waits for them.
LocalOutcome run_round(FarmPlan& plan, int round, SignalInbox& inbox) {
  const bool idle = chunks_of_round(plan, round).empty(), local = plan.engine == "local";
  if (idle || local) note_round(plan, round, {});
  if (idle) return {};
  if (local) return run_locally(plan, round, inbox);
  const std::string job = submit_to_slurm(array_submission(plan, round));
  note_round(plan, round, job);
  fmt::print("{}\n", job);
  std::fflush(stdout);
  LocalOutcome outcome;
  outcome.signal = wait_for_slurm(job, inbox);
  return outcome;
}

[[noreturn]] void fail_for(const FarmPlan& plan, const LocalOutcome& outcome,
                           const FramesVerdict& verdict) {
  const std::string text = missing_text(plan, verdict);
  if (outcome.failed) throw std::runtime_error(text);
  throw FramesLacking(text);
}

void conclude_or_submit(const FarmPlan& plan, int round) {
  if (!plan.rounds.empty() && plan.rounds.back().round > round) {
    if (!plan.rounds.back().job.empty())
      return announce(fmt::format("round {} has been submitted already", round + 1));
    // An earlier run of this job was ended after it wrote the plan and before it submitted the
    // round.
    return announce("job " + submit_round(plan, round + 1));
  }
  stop_if_cancelled(plan, round);
  const FramesVerdict verdict = verify_frames(plan);
  if (verdict.complete) return finish_plan(plan, verdict);
  if (round >= plan.most_rounds) throw FramesLacking(missing_text(plan, verdict));
  const FarmPlan next = next_round(plan, verdict);
  write_plan(next);
  announce("job " + submit_round(next, round + 1));
}

}  // namespace

int run_rounds(FarmPlan plan) {
  for (int round = 0;; ++round) {
    LocalOutcome outcome;
    {
      SignalInbox inbox;
      outcome = run_round(plan, round, inbox);
    }
    if (outcome.signal != 0) return outcome.signal;
    if (outcome.refused)
      throw InputError(plan.show.string() + ": the show was good at first, and is refused now; " +
                       "the lines above say why");
    if (outcome.away)
      throw TemporaryError(plan.out.string() +
                           ": not all frames are made; run the same command again");
    stop_if_cancelled(plan, round);
    const FramesVerdict verdict = verify_frames(plan);
    if (verdict.complete) {
      do_noted(plan, [&] { finish_plan(plan, verdict); });
      return 0;
    }
    // What was tried as often as it may be here is not tried again in another round.
    if (outcome.failed || outcome.given_up > 0 || round >= plan.most_rounds)
      fail_for(plan, outcome, verdict);
    plan = next_round(plan, verdict);
    write_plan(plan);
  }
}

std::string submit_round(FarmPlan plan, int round) {
  std::string job;
  if (!chunks_of_round(plan, round).empty()) job = submit_to_slurm(array_submission(plan, round));
  // The array runs already, and its plan is complete on the disk, but for the job's id.
  std::string conclusion;
  try {
    conclusion = submit_to_slurm(conclusion_submission(plan, round, job));
  } catch (...) {
    if (!job.empty()) cancel_slurm_job(job);
    throw;
  }
  note_round(plan, round, job.empty() ? conclusion : job);
  if (!job.empty())
    announce(fmt::format(
        "job {} renders, and job {} verifies when it has ended; scancel {} {} ends both", job,
        conclusion, job, conclusion));
  return plan.rounds.back().job;
}

void conclude_round(const FarmPlan& plan, int round) {
  do_noted(plan, [&] { conclude_or_submit(plan, round); });
}

}  // namespace domefall
