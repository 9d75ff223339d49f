// This file says how the work on a folder of frames goes, which is how quickly, what took long, and
// what failed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/render/frames/manifest.h"

namespace domefall {

// Returns the frames a second that all processes which still live have finished together in the
// last ten minutes, or since the first of them began if that is later.  `now_s` is since 1970.
// Returns nothing if no process lives, or none of them has finished a frame in that time.
std::optional<double> frames_per_second(const Manifest& manifest, double now_s);

struct SlowFrame {
  int frame = 0;
  double seconds = 0;
  std::string host;
};

// Returns those of these frames that took longest, slowest first, each once, by its last making.
// `among` is sorted.
std::vector<SlowFrame> slowest_frames(const Manifest& manifest, const std::vector<int>& among,
                                      std::size_t most);

// Returns the last line of a log that is not blank, without control characters.  Where the log
// cannot be read, this returns why.
std::string last_line_of(const std::filesystem::path& log);

// TaskFrames are the frames that one task of a farm is to make.
struct TaskFrames {
  int round = 0, task = 0;
  std::vector<int> frames;        // sorted
  std::vector<std::string> logs;  // ends of the stems that its logs may have: _JOB_TASK
};

struct FailedChunk {
  int round = 0, task = 0;
  std::vector<int> lacking;
  std::filesystem::path log;
  std::string last_line;
};

// Returns tasks of which frames are lacking, none is being made, and a log is in DIR/farm/log, with
// the one that was written last.  One whose log ends well has not failed, because its frames were
// lost or outdated later.  Nor has one whose log is empty, in its first seconds.  A frame counts
// for the last task that has it, so that one that is submitted again has not failed before that
// task began.  `tasks` are in the order of their rounds, and `lacking` is sorted.
std::vector<FailedChunk> failed_chunks(const std::vector<TaskFrames>& tasks,
                                       const std::vector<int>& lacking, const Manifest& manifest,
                                       const std::filesystem::path& frames);

}  // namespace domefall
