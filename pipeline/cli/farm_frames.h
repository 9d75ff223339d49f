// FarmFrames say what a folder of frames is to hold, as the verbs of the farm are asked for it.
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

// The texts are those of the options of `domefall render`.  An empty one stands for what the plan
// in DIR/farm says.  Where there is no plan, or `show` is given, it stands for the default of that
// option.
struct FarmRequest {
  std::string folder, plan, show, frames, size, overlays;
  int threads = 0;
};

void add_farm_options(CLI::App& verb, FarmRequest& request);

// Returns how many threads look at files, which is as many as are asked for.  Otherwise it is at
// least four, because these threads wait for disks and file servers and not for processors.
int reading_threads(const FarmRequest& request);

class FarmFrames {
 public:
  // Throws InputError where neither the request nor a plan names a show.  Throws TemporaryError if
  // there is no such folder.  Also throws as domefall::read_plan, read_show, parse_frames, Grader
  // and FrameKeys.
  explicit FarmFrames(FarmRequest request);
  FarmFrames(const FarmFrames&) = delete;
  FarmFrames(FarmFrames&&) = delete;
  FarmFrames& operator=(const FarmFrames&) = delete;
  FarmFrames& operator=(FarmFrames&&) = delete;
  ~FarmFrames() = default;

  const Show& show() const { return show_; }
  const FrameFolder& folder() const { return *folder_; }
  const std::vector<int>& frames() const { return frames_; }
  // Returns what conclusion_of() says of the work after the plan's frames, or an empty text where
  // there is no plan.
  std::string conclusion() const { return conclusion_of(folder_->path(), plan_id_); }
  // Returns the tasks of the plan, or none where there is no plan.
  const std::vector<TaskFrames>& tasks() const { return tasks_; }
  // Returns the grader of the show, or nothing where the show keeps no graded frames.
  const std::optional<Grader>& grader() const { return grader_; }

  // Returns the files of the frames, each with the key that it has today.
  std::vector<ExpectedFile> files() const;

  // Counts by segment the frames that a changed show makes stale, which `domefall render` reports
  // too.
  FrameSurvey invalidated(const FolderFindings& found) const;

  // Returns the files that are not the show's, sorted and below the folder.  They are `strangers`
  // (FrameFolder::strangers), and files of others under the names of the show's frames.
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
