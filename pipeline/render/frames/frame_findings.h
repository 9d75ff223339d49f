// What the files of frames in a folder are found to be, file by file and frame by frame.  All that
// asks whether a frame is good asks here: runs before they make frames, the farm, movies and
// deliveries.
#pragma once

#include <array>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "pipeline/image/frame_check.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/frames/manifest.h"

namespace domefall {

// The reason of an unreadable file is why it cannot be read.
struct FileFinding : FrameCheck {
  // These are set for a good file of which every byte was read.
  bool black = false;       // no value exceeds one code of 8 bits
  bool not_finite = false;  // a value is infinite or no number
  bool unlike = false;      // no manifest that has its key has its digest
};

// Tells by the manifest where that has a line for the file as it lies there, and otherwise by the
// file's beginning.  A file of the wanted key, but of another length than was noted, is damaged.
FileFinding glance_at(const ExpectedFile& file, const Manifest& manifest);

// Reads every byte.  A file that is as it was written, and is in the manifest, was seen by its
// writer to be finite and has its brightness there.  Any other good one is decoded.
FileFinding examine_file(const ExpectedFile& file, const Manifest& manifest);

// Looks at the files on so many threads.  A signal ends the work, as stop_if_interrupted().
std::vector<FileFinding> look_at_files(const std::vector<ExpectedFile>& files, int threads,
                                       const std::function<FileFinding(const ExpectedFile&)>& look);

// Each list of frames is sorted.
struct FolderFindings {
  std::array<std::vector<int>, kFrameConditions> frames;  // by their conditions

  // These are the frames with an older linear file, and those of which only the graded one is.
  std::vector<int> older_linear, older_graded;
  // Good frames may be among these.
  std::vector<int> black_linear, black_graded;  // which the show may intend
  std::vector<int> not_finite;                  // with values that are no finite numbers
  std::vector<int> unlike;  // whole, but not with the bytes that their writers noted

  struct OtherFile {
    int frame;
    std::string name, reason;  // below the folder, as that of FrameCheck
  };
  std::vector<OtherFile> others;  // files of others under the names of frames

  std::map<int, std::string> reasons;  // why a frame is unreadable

  const std::vector<int>& of(FrameCondition condition) const {
    return frames[static_cast<std::size_t>(condition)];
  }
  const std::vector<int>& good() const { return of(FrameCondition::kGood); }
  // Returns what a run over the frames makes, which is all that is neither good nor unreadable.
  std::vector<int> to_make() const;
};

// Takes findings in the order of the files, which are in the order of their frames.
FolderFindings sum_up(const std::vector<ExpectedFile>& files,
                      const std::vector<FileFinding>& findings);

// Returns the numbers that are in any of the lists, sorted.
std::vector<int> joined_frames(std::initializer_list<const std::vector<int>*> lists);

// Looks at files before a run makes them anew.  Reads their beginnings.  Files of another size, show
// or kind are read whole, until one of them is known to be undamaged; those before are damaged.
// Throws as check_frame() for a file that cannot be read.
FolderFindings survey_files(const std::vector<ExpectedFile>& files);

// Throws InputError if a run would replace good frames of another size, show or kind.
void refuse_to_replace(const FolderFindings& found, const FrameFolder& folder);

// Counts frames by their segments.
std::map<int, int> by_segment(const std::vector<int>& frames, const Show& show);

// Returns a line for each kind of work that an edit of the show costs, such as "segments 3 and 4:
// 1,260 frames will be made again", or an empty text if there is none.
std::string describe_work(const FolderFindings& found, const Show& show);

// Returns one line about a folder's foreign files, such as "40 files are not this show's, and are left
// alone: ...", or an empty text if there are none.
std::string describe_foreign(const std::vector<std::string>& files, const FrameFolder& folder);

}  // namespace domefall
