// What a folder of frames is to hold, as the verbs of the farm are asked for it.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/farm/conclusion_note.h"
#include "pipeline/farm/folder_findings.h"
#include "pipeline/farm/work_summary.h"
#include "pipeline/grade/grader.h"
#include "pipeline/render/frame_key.h"

namespace domefall {

// Texts are those of the options of `domefall render`; an empty one stands for what
// the plan in DIR/farm says, or else for that option's default.
struct FarmRequest {
  std::string folder, plan, show, frames, size, overlays;
  int threads = 0;
};

void add_farm_options(CLI::App& verb, FarmRequest& request);

// How many threads look at files: as many as are asked for, or else four at least, since they wait
// for disks and file servers and not for processors.
int reading_threads(const FarmRequest& request);

class FarmFrames {
 public:
  // Throws InputError where no show is named, by the request or by a plan, as read_plan(), and as
  // read_show, parse_frames, Grader and FrameKeys; TemporaryError if there is no such folder.
  explicit FarmFrames(FarmRequest request);
  FarmFrames(const FarmFrames&) = delete;
  FarmFrames(FarmFrames&&) = delete;
  FarmFrames& operator=(const FarmFrames&) = delete;
  FarmFrames& operator=(FarmFrames&&) = delete;
  ~FarmFrames() = default;

  const Show& show() const { return show_; }
  const FrameFolder& folder() const { return *folder_; }
  const std::vector<int>& frames() const { return frames_; }
  // Of the work after the frames of the plan (conclusion_of()); empty where there is no plan.
  std::string conclusion() const { return conclusion_of(folder_->path(), plan_id_); }
  // Of the plan; empty where there is none.
  const std::vector<TaskFrames>& tasks() const { return tasks_; }
  // The grade of the show; nothing where it keeps no graded frames.
  const std::optional<Grader>& grader() const { return grader_; }

  // The files of the frames, each with the key that it has today.
  std::vector<ExpectedFile> files() const;

  // What a changed show costs, by segments, as `domefall render` says it.
  FrameSurvey invalidated(const FolderFindings& found) const;

  // Files that are not the show's (FrameFolder::strangers), and those of others under the names of
  // its frames, sorted and below the folder.
  static std::vector<std::string> foreign(const FolderFindings& found,
                                          const std::vector<std::filesystem::path>& strangers);

 private:
  void read_plan(FarmRequest& request);
  ExpectedFile expected(int frame, std::filesystem::path path, std::string key) const;

  Show show_;
  std::string plan_id_;
  std::vector<int> frames_;
  std::vector<TaskFrames> tasks_;
  std::optional<FrameFolder> folder_;
  std::optional<Grader> grader_;
  std::optional<FrameKeys> keys_;
};

}  // namespace domefall
