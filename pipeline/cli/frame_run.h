// A run over the frames of a show.  It makes what is missing, damaged or of another version of the
// show, and leaves alone what is good.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/show/show.h"

namespace domefall {

// The program that frames name in their headers.
inline constexpr const char* kSoftware = "Domefall " DOMEFALL_VERSION;

struct FrameRun {
  const Show& show;
  std::vector<int> frames;
  std::filesystem::path folder;  // gets linear/NAME_00000.exr and graded/NAME_00000.png
  int threads = 0;               // 0 stands for one per processor
  bool explain = false;          // prints each frame's plan and what its stages cost
  bool render = true;            // false for a run that only grades frames that are there
};

// Makes the frames.  Throws InputError, TemporaryError or Interrupted; frames finished before stay.
void run_frames(const FrameRun& run);

// A projection with the size that --size gives: 1k, 2k, 4k, 8k or pixels for a dome, and
// WIDTHxHEIGHT for a flat image.  An empty text leaves it as it is.  Throws InputError for any
// other text.
Projection resized(const Projection& projection, const std::string& size);

}  // namespace domefall
