// FarmFrames say what a folder of frames is to hold, as the verbs of the farm are asked for it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "farm/conclusion_note.h"
#include "farm/work_summary.h"
#include "pipeline/grade/grader.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/frames/frame_findings.h"

namespace domefall {

// The texts are those of the options of `domefall render`.  An empty one stands for what the plan
// in DIR/farm says.  Where there is no plan, or `show` is given, it stands for the default of that
// option.
struct FarmRequest {
  std::string folder, plan, show, frames, size, overlays;
  int threads = 0;
};

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
  FarmFrames& operator=(const FarmFrames&) = delete;
  ~FarmFrames() = default;

  const Show& show() const { return show_; }
  const FrameFolder& folder() const { return *folder_; }
  const std::vector<int>& frames() const { return frames_; }
  // Returns what conclusion_of() says of the work after the plan's frames, or an empty text where
  // there is no plan.
  std::string conclusion() const { return conclusion_of(folder_->path(), plan_id_); }
  // Returns the tasks of the plan, or none where there is no plan.
  const std::vector<TaskFrames>& tasks() const { return tasks_; }
  // Returns the grader of the show, or null where the show keeps no graded frames.
  const Grader* grader() const { return grader_ ? &*grader_ : nullptr; }

  // Returns the files of the frames, each with the key that it has today.
  std::vector<ExpectedFile> files() const { return folder_->files(frames_, *keys_); }

 private:
  void read_plan(FarmRequest& request);

  Show show_;
  std::string plan_id_;
  std::vector<int> frames_;
  std::vector<TaskFrames> tasks_;
  std::optional<FrameFolder> folder_;
  std::optional<Grader> grader_;
  std::optional<FrameKeys> keys_;
};

// Adds to the files that are not the show's those of others under the names of its frames.
std::vector<std::string> with_others(std::vector<std::string> foreign, const FolderFindings& found);

// Frames that are not good, in the order in which JSON has them, and as the status calls them.
struct BadFrames {
  FrameCondition condition;
  const char *key, *word;
};
inline constexpr BadFrames kBadFrames[] = {
    {FrameCondition::kMissing, "missing", "missing"},
    {FrameCondition::kDamaged, "damaged", "damaged"},
    {FrameCondition::kOther, "others", "another's"},
    {FrameCondition::kOlder, "stale", "stale"},
    {FrameCondition::kUnreadable, "unreadable", "unreadable"}};
void add_bad_frames(nlohmann::ordered_json& json, const FolderFindings& found);

}  // namespace domefall
