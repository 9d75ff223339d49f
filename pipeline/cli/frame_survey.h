// What a run over frames finds in their folder, before it makes any.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/cli/frame_folder.h"
#include "pipeline/render/frame_key.h"

namespace domefall {

struct FrameSurvey {
  std::vector<int> to_make;  // what is not good by what its files say of themselves

  // Frames of another version of the show, by segment: to be rendered again, or only graded again.
  std::map<int, int> older, older_grades;

  // Frames of another size, show or kind that the run would replace: how many, and the first file
  // of them that is whole.  Where all turned out to be damaged the path is empty.
  int others = 0;
  std::filesystem::path first_other;
  std::string first_difference;
};

// Reads the beginnings of the files of these frames, and nothing of others.  A run that only grades
// leaves the linear ones alone.  Throws as claimed_condition() and stop_if_interrupted().
FrameSurvey survey_frames(const FrameFolder& folder, const Show& show, const FrameKeys& keys,
                          const std::vector<int>& frames, bool renders);

// Throws InputError if the run would replace good frames of another size, show or kind.
void refuse_to_replace(const FrameSurvey& survey, const FrameFolder& folder);

// "segments 3 and 4: 1,260 frames will be made again", a line for each kind of work; perhaps empty.
std::string describe_work(const FrameSurvey& survey);

// "40 files are not this show's, and are left alone: ..." in one line.
std::string describe_strangers(const std::vector<std::string>& files);
// What lies in the folder and is not the show's, with the folder's path; empty where there is
// nothing.
std::string describe_strangers(const FrameFolder& folder);

}  // namespace domefall
