#include "pipeline/farm/finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "pipeline/farm/worker_process.h"
#include "pipeline/image/errors.h"
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

// Adds words to a command where a value is given.
void add_option(std::vector<std::string>& command, const std::string& name,
                const std::string& value) {
  if (!value.empty()) command.insert(command.end(), {name, value});
}

// Adds an option of the frames, if they have it.
void add_option_of_frames(std::vector<std::string>& command, const FarmPlan& plan,
                          const std::string& name) {
  const auto at = std::ranges::find(plan.options, name);
  if (at != plan.options.end()) add_option(command, name, *(at + 1));
}

}  // namespace

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

std::vector<std::string> movie_command(const FarmPlan& plan) {
  std::vector<std::string> command{plan.program, "movie",  plan.show.string(), "--preset",
                                   plan.movie,   "--from", plan.out.string()};
  add_option(command, "--out", plan.movie_file);
  add_option(command, "--frames", plan.frames);
  add_option_of_frames(command, plan, "--size");
  add_option_of_frames(command, plan, "--overlay");
  command.insert(command.end(), plan.movie_options.begin(), plan.movie_options.end());
  return command;
}

std::vector<std::string> deliver_command(const FarmPlan& plan) {
  std::vector<std::string> command{plan.program,      "deliver", plan.show.string(), "--from",
                                   plan.out.string(), "--out",   plan.deliver};
  add_option_of_frames(command, plan, "--size");
  add_option_of_frames(command, plan, "--overlay");
  command.insert(command.end(), plan.deliver_options.begin(), plan.deliver_options.end());
  return command;
}

void make_movie_and_delivery(const FarmPlan& plan) {
  for (const auto& command :
       {plan.movie.empty() ? std::vector<std::string>() : movie_command(plan),
        plan.deliver.empty() ? std::vector<std::string>() : deliver_command(plan)}) {
    if (command.empty()) continue;
    std::fprintf(stderr, "%s\n", run_verb(command).c_str());
  }
}

}  // namespace domefall
