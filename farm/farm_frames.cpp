#include "farm/farm_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "farm/plan.h"
#include "pipeline/base/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frames/graded_frames.h"
#include "pipeline/render/thread_limit.h"
#include "pipeline/show/file/read_show.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// Returns the value of an option, given as "--size 512" or as "--size=512", or an empty text if the
// option is not there.
std::string option_in(const std::vector<std::string>& options, const std::string& name) {
  for (std::size_t k = 0; k < options.size(); ++k) {
    if (options[k] == name && k + 1 < options.size()) return options[k + 1];
    if (options[k].starts_with(name + "=")) return options[k].substr(name.size() + 1);
  }
  return {};
}

// Returns what is known of a task.  Its log is named after the engine's job and the task, or after
// the plan, its round and the task where there are no jobs.
TaskFrames task_of(const PlannedChunk& chunk, const FarmPlan& plan) {
  TaskFrames task{chunk.round, chunk.task, parse_frames(chunk.frames, kMostFrames), {}};
  task.logs.push_back(fmt::format("_{}_{}_{}", plan.id, chunk.round, chunk.task));
  for (const FarmRound& round : plan.rounds)
    if (round.round == chunk.round && !round.job.empty())
      task.logs.push_back(fmt::format("_{}_{}", round.job, chunk.task));
  return task;
}

void require_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (!error && fs::exists(folder, error)) throw InputError(folder.string() + ": is no folder");
  // Another machine may have the folder, or a file server may come back.
  throw TemporaryError(folder.string() + ": there is no such folder here");
}

}  // namespace

int reading_threads(const FarmRequest& request) {
  constexpr int kLeast = 4;
  return request.threads > 0 ? request.threads : std::max(kLeast, all_threads(0));
}

void FarmFrames::read_plan(FarmRequest& request) {
  const fs::path folder = request.folder;
  const auto plan = request.plan.empty() ? newest_plan(folder)
                                         : std::optional(domefall::read_plan(folder, request.plan));
  if (!plan) {
    if (request.show.empty())
      throw InputError(farm_folder(folder).string() +
                       ": there is no plan; name the show by --show");
    return;
  }
  plan_id_ = plan->id;
  // A plan for one show says nothing of another.
  if (request.show.empty()) {
    request.show = plan->show;
    if (request.frames.empty()) request.frames = plan->frames;
    if (request.size.empty()) request.size = option_in(plan->options, "--size");
    if (request.overlays.empty()) request.overlays = option_in(plan->options, "--overlay");
  }
  for (const PlannedChunk& chunk : plan->chunks) tasks_.push_back(task_of(chunk, *plan));
}

FarmFrames::FarmFrames(FarmRequest request) {
  require_folder(request.folder);
  read_plan(request);
  show_ = read_show(request.show, request.size, request.overlays);
  frames_ = parse_frames(request.frames, frame_count(show_));
  folder_.emplace(request.folder, show_);
  if (show_.output.graded) grader_.emplace(show_.grade);
  keys_.emplace(show_, grade_id(show_, grader()));
}

std::vector<std::string> with_others(std::vector<std::string> foreign,
                                     const FolderFindings& found) {
  for (const auto& other : found.others) foreign.push_back(other.name);
  std::ranges::sort(foreign);
  return foreign;
}

void add_bad_frames(nlohmann::ordered_json& json, const FolderFindings& found) {
  for (const BadFrames& bad : kBadFrames) json[bad.key] = as_ranges(found.of(bad.condition));
}

}  // namespace domefall
