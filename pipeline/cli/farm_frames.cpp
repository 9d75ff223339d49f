#include "pipeline/cli/farm_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/cli/number_in.h"
#include "pipeline/cli/option_types.h"
#include "pipeline/cli/overlay_option.h"
#include "pipeline/farm/manifest.h"
#include "pipeline/farm/plan.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/show/frame_size.h"
#include "pipeline/show/read_show.h"

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

std::string grade_id_of(const std::optional<Grader>& grader, const Show& show) {
  return grader ? grader->transform_id() + format_id(*show.output.graded) : std::string();
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

void add_farm_options(CLI::App& verb, FarmRequest& request) {
  verb.add_option("DIR", request.folder, "folder of the frames")
      ->type_name(kFolderType)
      ->required();
  verb.add_option("--show", request.show, "show file (YAML); default as planned")
      ->type_name(kFileType);
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
  show_ = read_show(request.show);
  overlay(show_, request.overlays);
  show_.projection = resized(show_.projection, request.size);
  frames_ = parse_frames(request.frames, frame_count(show_));
  folder_.emplace(request.folder, show_);
  if (show_.output.graded) grader_.emplace(show_.grade);
  keys_.emplace(show_, grade_id_of(grader_, show_));
}

ExpectedFile FarmFrames::expected(int frame, fs::path path, std::string key) const {
  std::string name = path.lexically_relative(folder_->path()).string();
  return {frame, std::move(path), std::move(name), folder_->wanted(std::move(key))};
}

std::vector<ExpectedFile> FarmFrames::files() const {
  std::vector<ExpectedFile> files;
  files.reserve(2 * frames_.size());
  for (const int frame : frames_) {
    const FrameState state = frame_state(show_, frame);
    const std::string key = keys_->scene(state);
    if (folder_->has_linear()) files.push_back(expected(frame, folder_->linear(frame), key));
    if (folder_->has_graded())
      files.push_back(expected(frame, folder_->graded(frame), keys_->graded(key, state)));
  }
  return files;
}

FrameSurvey FarmFrames::invalidated(const FolderFindings& found) const {
  FrameSurvey survey;
  for (const int frame : found.stale_linear) ++survey.older[frame_state(show_, frame).segment];
  for (const int frame : found.stale_grades)
    ++survey.older_grades[frame_state(show_, frame).segment];
  return survey;
}

std::vector<std::string> FarmFrames::foreign(const FolderFindings& found,
                                             const std::vector<fs::path>& strangers) {
  std::vector<std::string> names;
  names.reserve(strangers.size() + found.others_files.size());
  for (const fs::path& file : strangers) names.push_back(file.string());
  for (const fs::path& file : found.others_files) names.push_back(file.string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace domefall
