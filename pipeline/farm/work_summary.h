// How the work on a folder of frames goes: how quickly, what took long, and what failed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/farm/manifest.h"

namespace domefall {

// Frames a second that all processes together have finished in the last ten minutes, or since the
// first of them began if that is later; `now_s` is since 1970.  Nothing if none of them lives, or
// none has finished a frame.
std::optional<double> frames_per_second(const Manifest& manifest, double now_s);

struct SlowFrame {
  int frame = 0;
  double seconds = 0;
  std::string host;
};

// The frames that took longest, slowest first; each once, by its last making.
std::vector<SlowFrame> slowest_frames(const Manifest& manifest, std::size_t most);

// The frames that one task of a farm is to make.
struct FarmChunk {
  int task = 0;
  std::vector<int> frames;  // sorted
};

struct FailedChunk {
  int task = 0;
  std::vector<int> lacking;
  std::filesystem::path log;
  std::string last_line;
};

// Chunks that lack frames, of which none is being made, and whose task has left a log.  `lacking`
// is sorted.  The log is the file in DIR/farm/log that was written last of those in whose stems the
// last number is that of the task.
std::vector<FailedChunk> failed_chunks(const std::vector<FarmChunk>& chunks,
                                       const std::vector<int>& lacking, const Manifest& manifest,
                                       const std::filesystem::path& frames);

}  // namespace domefall
