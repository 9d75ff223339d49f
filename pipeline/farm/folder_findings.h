// FolderFindings say what a folder of frames is found to hold, frame by frame.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "pipeline/farm/file_finding.h"

namespace domefall {

// Each list of frames is sorted.  A frame is in the first of the lists down to `stale` that one of
// its files belongs to, or else good, and may then be in those below.
struct FolderFindings {
  std::vector<int> unreadable, missing, damaged;
  std::vector<int> others;  // a frame of another show, size or kind bears its name
  std::vector<int> stale;   // of another version of the show or of its grade
  std::vector<int> good;

  std::vector<int> black_linear, black_graded;  // which the show may intend
  std::vector<int> not_finite;                  // with values that are no finite numbers
  std::vector<int> unlike;  // whole, but not with the bytes that their writers noted

  std::map<int, std::string> reasons;               // why a frame is unreadable
  std::vector<std::filesystem::path> others_files;  // of `others`, below the folder
  // These are the frames whose linear file is stale, and those of which only the graded one is.
  std::vector<int> stale_linear, stale_grades;

  // Returns what a run over the frames makes, which is all that is neither good nor unreadable.
  std::vector<int> to_make() const;
};

using LookAtFile = FileFinding (*)(const ExpectedFile&, const Manifest&);

// Looks at files by glance_at or examine_file, on so many threads.  Each thread calls step() before
// each file.  What step() throws ends the work.
std::vector<FileFinding> look_at_files(
    const std::vector<ExpectedFile>& files, const Manifest& manifest, LookAtFile look, int threads,
    const std::function<void()>& step = [] {});

// Takes findings in the order of the files, which are in the order of their frames.
FolderFindings sum_up(const std::vector<ExpectedFile>& files,
                      const std::vector<FileFinding>& findings);

// Returns the numbers that are in any of the lists, sorted.
std::vector<int> joined_frames(std::initializer_list<const std::vector<int>*> lists);

}  // namespace domefall
