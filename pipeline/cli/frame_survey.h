// A FrameSurvey is what a run over frames finds in their folder, before it makes any.
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

  // These count, by segment, the frames of another version of the show that are to be rendered
  // again, and those that are only to be graded again.
  std::map<int, int> older, older_grades;

  // `others` counts the frames of another size, show or kind that the run would replace.
  // `first_other` is the first of their files that is whole, and is empty where all turned out to
  // be damaged.
  int others = 0;
  std::filesystem::path first_other;
  std::string first_difference;
};

// Reads the beginnings of the files of these frames, and nothing of other files.  Files of another
// size, show or kind are read whole, until one of them is known to be undamaged.  A run that only
// grades leaves the linear files alone.  Throws as claimed_condition() and stop_if_interrupted().
FrameSurvey survey_frames(const FrameFolder& folder, const Show& show, const FrameKeys& keys,
                          const std::vector<int>& frames, bool renders);

// Throws InputError if the run would replace good frames of another size, show or kind.
void refuse_to_replace(const FrameSurvey& survey, const FrameFolder& folder);

// Returns a line for each kind of work, such as "segments 3 and 4: 1,260 frames will be made
// again", or an empty text if there is none.
std::string describe_work(const FrameSurvey& survey);

// Returns one line, such as "40 files are not this show's, and are left alone: ...".
std::string describe_strangers(const std::vector<std::string>& files);
// Returns such a line about what lies in the folder and is not the show's, after the folder's path.
// The text is empty where there is nothing.
std::string describe_strangers(const FrameFolder& folder);

}  // namespace domefall
