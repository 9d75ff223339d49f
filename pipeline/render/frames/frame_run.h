// A FrameRun goes over the frames of a show.  It makes what is missing, damaged or of another
// version of the show, and leaves alone what is good.  Good frames of another size, show or kind it
// replaces only if that is asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "pipeline/grade/grader.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/graded_file.h"
#include "pipeline/render/frames/progress.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

// Frames name this program in their headers.
inline constexpr const char* kSoftware = "Domefall " DOMEFALL_VERSION;

// Return what the file of a frame says of it.  `digest` is that of the version of the show, and
// `observer` the one who is named.
FrameInfo frame_info(const Show& show, const std::string& digest, const FrameState& state,
                     const ObserverState& observer, const std::string& key);
GradedInfo graded_info(const Show& show, const Projection& projection, int frame,
                       const Grader& grader, const std::string& key);

struct FrameRun {
  const Show& show;
  std::vector<int> frames;
  std::filesystem::path folder;  // gets linear/NAME_00000.exr and graded/NAME_00000.png, or lens/
  int threads = 0;               // 0 stands for one per processor
  bool explain = false;          // prints each frame's plan and what its stages cost
  bool render = true;            // false for a run that only grades frames that are there
  bool replace = false;          // good frames of another size, show or kind too
  bool dry = false;              // only prints the frames that it would make, judged by their heads
  std::optional<ProgressForm> progress = std::nullopt;  // with nothing, a bar on the terminal
};

// Returns the frames that a run would make, judged by the heads of the files that are there.  Says
// on standard error what an edit of the show costs, and which files are not its own.  Throws as
// run_frames().
std::vector<int> frames_to_make(const FrameRun& run);

// Makes the frames.  Throws InputError, TemporaryError or Interrupted.  Frames finished before
// stay.
void run_frames(const FrameRun& run);

// Writes the lens maps of the frames in the same manner.  No sky and no catalogue is read.
void run_lens_maps(const FrameRun& run);

}  // namespace domefall
