// A run over frames: make what is missing, damaged or of another version of the show, and leave
// alone what is good.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/show/show.h"

namespace domefall {

// What frames say they were made by.
inline constexpr const char* kSoftware = "Domefall " DOMEFALL_VERSION;

struct FrameRun {
  const Show& show;
  std::vector<int> frames;
  std::filesystem::path folder;  // gets linear/NAME_00000.exr and graded/NAME_00000.png
  int threads = 0;               // 0: one per processor
  bool explain = false;          // print each frame's plan and what its stages cost
  bool render = true;            // false: only grade frames that are there
};

// Throws InputError, TemporaryError or Interrupted; what was finished before stays.
void run_frames(const FrameRun& run);

// --size: 1k, 2k, 4k, 8k or pixels for a dome; WIDTHxHEIGHT for a flat picture.  Empty: the show's.
Projection resized(const Projection& projection, const std::string& size);

}  // namespace domefall
