#include "farm/rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "farm/commands.h"
#include "farm/conclusion_note.h"
#include "farm/engine.h"
#include "farm/signal_inbox.h"
#include "farm/worker_process.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/show/show.h"

namespace domefall {
namespace {

// Runs a verb of domefall and returns what it prints and says.  Throws for any code but 0 and
// `also`.
std::string run_verb(const std::vector<std::string>& command, int also = 0) {
  std::string said;
  const WorkerEnd end = run_program(command, said);
  while (!said.empty() && said.back() == '\n') said.pop_back();
  if (end.signal == 0 && (end.code == 0 || end.code == also)) return said;
  const std::string what = said.empty() ? command.front() + ": " + end.text() : said;
  constexpr int kInputCode = 2, kTemporaryCode = 75, kNotStartedCode = 127;
  if (end.code == kInputCode) throw InputError(what);
  if (end.signal != 0 || end.code == kTemporaryCode || end.code >= kNotStartedCode)
    throw TemporaryError(what);
  throw std::runtime_error(what);
}

// Runs `domefall farm verify`, which reads all frames.  Throws InputError and TemporaryError as it
// does.
FramesVerdict verify_frames(const FarmPlan& plan) {
  constexpr int kIncomplete = 1;
  const std::string said =
      run_verb({plan.program, "farm", "verify", plan.out.string(), "--plan", plan.id, "--json"},
               kIncomplete);
  // What is said besides is for people.
  const std::size_t begin = ("\n" + said).find("\n{"), end = said.find("\n}", begin);
  FramesVerdict verdict;
  try {
    const auto json = nlohmann::json::parse(
        begin == std::string::npos ? "" : said.substr(begin, end + 2 - begin));
    verdict.to_make = json.at("to_make").get<std::string>();
    verdict.frames = json.at("frames");
    verdict.to_make_count = verdict.frames - json.at("good").get<int>();
  } catch (const nlohmann::json::exception&) {
    throw TemporaryError("domefall farm verify: " + said);
  }
  verdict.complete = verdict.to_make.empty();
  return verdict;
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
  say(fmt::format("all {} frames are there: {}", verdict.frames, plan.out.string()));
  for (const auto& [name, command] : product_commands(plan)) say(run_verb(command));
}

FarmPlan next_round(const FarmPlan& plan, const FramesVerdict& verdict) {
  FarmPlan next = with_round(plan, verdict, engine_of(plan).most_tasks(false));
  say(fmt::format("round {} of at most {}: frames {} ({} of {}) are rendered again",
                  next.rounds.back().round, plan.most_rounds, verdict.to_make,
                  verdict.to_make_count, verdict.frames));
  return next;
}

// Throws where somebody has cancelled the tasks of a round, since then they are not rendered again.
void stop_if_cancelled(const FarmPlan& plan, int round) {
  const auto was_cancelled = engine_of(plan).was_cancelled;
  if (!was_cancelled) return;
  for (const FarmRound& one : plan.rounds)
    if (one.round == round && !one.job.empty() && was_cancelled(one.job))
      throw FramesLacking("job " + one.job + " was cancelled, so that nothing more is made in " +
                          plan.out.string() + "; the same submission goes on with what is left");
}

// Renders the chunks of a round and waits for them.
RoundOutcome run_round(FarmPlan& plan, int round, SignalInbox& inbox) {
  const Engine& engine = engine_of(plan);
  const bool idle = chunks_of_round(plan, round).empty();
  const std::string job = idle ? std::string() : engine.start(plan, round);
  note_round(plan, round, job);
  if (idle) return {};
  if (!job.empty()) fmt::print("{}\n", job);
  std::fflush(stdout);
  return engine.wait(plan, round, job, inbox);
}

[[noreturn]] void fail_for(const FarmPlan& plan, const RoundOutcome& outcome,
                           const FramesVerdict& verdict) {
  const std::string text = missing_text(plan, verdict);
  if (outcome.failed) throw std::runtime_error(text);
  throw FramesLacking(text);
}

void conclude_or_submit(const FarmPlan& plan, int round) {
  if (!plan.rounds.empty() && plan.rounds.back().round > round) {
    if (!plan.rounds.back().job.empty())
      return say(fmt::format("round {} has been submitted already", round + 1));
    // An earlier run of this job was ended after it wrote the plan and before it submitted the
    // round.
    return say("job " + submit_round(plan, round + 1));
  }
  stop_if_cancelled(plan, round);
  const FramesVerdict verdict = verify_frames(plan);
  if (verdict.complete) return finish_plan(plan, verdict);
  if (round >= plan.most_rounds) throw FramesLacking(missing_text(plan, verdict));
  const FarmPlan next = next_round(plan, verdict);
  write_plan(next);
  say("job " + submit_round(next, round + 1));
}

}  // namespace

FarmPlan with_round(FarmPlan plan, const FramesVerdict& verdict, int most) {
  const int round = plan.rounds.empty() ? 1 : plan.rounds.back().round + 1;
  const auto first = chunks_of_round(plan, 0);
  const std::vector<int> frames = parse_frames(verdict.to_make, kMostFrames);
  // A chunk is as long as those of the first round, which left out the frames that were there.
  int planned = 0;
  for (const PlannedChunk& chunk : first)
    planned += static_cast<int>(parse_frames(chunk.frames, kMostFrames).size());
  const int wanted = std::max<int>(1, static_cast<int>(first.size()));
  const int per_chunk = std::max(
      {1, (planned + wanted - 1) / wanted, (static_cast<int>(frames.size()) + most - 1) / most});
  int task = 0;
  for (auto rest = std::span(frames); !rest.empty();) {
    const auto chunk = rest.first(std::min(rest.size(), static_cast<std::size_t>(per_chunk)));
    plan.chunks.push_back({round, task++, as_ranges({chunk.begin(), chunk.end()}), 0});
    rest = rest.subspan(chunk.size());
  }
  plan.rounds.push_back({round, {}, utc_now()});
  return plan;
}

int run_rounds(FarmPlan plan) {
  for (int round = 0;; ++round) {
    RoundOutcome outcome;
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
      do_noted(plan, {}, [&] { finish_plan(plan, verdict); });
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
  const Engine& engine = engine_of(plan);
  if (!engine.conclude)
    throw InputError(fmt::format("engine {}: its rounds are not concluded by jobs", engine.name));
  std::string job;
  if (!chunks_of_round(plan, round).empty()) job = engine.start(plan, round);
  // The array runs already, and its plan is complete on the disk, but for the job's id.
  std::string conclusion;
  try {
    conclusion = engine.conclude(plan, round, job);
  } catch (...) {
    if (!job.empty()) engine.cancel(job);
    throw;
  }
  note_round(plan, round, job.empty() ? conclusion : job);
  if (!job.empty())
    say(fmt::format("job {} renders, and job {} verifies when it has ended; {} {} {} ends both",
                    job, conclusion, engine.cancel_command, job, conclusion));
  return plan.rounds.back().job;
}

void conclude_round(const FarmPlan& plan, int round, const std::string& job) {
  const auto log = job.empty() ? std::filesystem::path()
                               : farm_folder(plan.out) / fmt::format("conclude_{}.log", job);
  do_noted(plan, log, [&] { conclude_or_submit(plan, round); });
}

}  // namespace domefall
