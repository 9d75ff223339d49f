// This file says what `domefall farm status` prints, for people and for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/farm_frames.h"

namespace domefall {

// A FarmStatus is the state of a folder at one moment.
struct FarmStatus {
  FolderFindings found;
  Manifest manifest;
  std::vector<std::string> foreign;
  std::optional<double> frames_per_second;
  std::vector<SlowFrame> slowest;
  std::vector<FailedChunk> failed;
  std::string conclusion;  // FarmFrames::conclusion()
  double now_s = 0;        // since 1970
};

// Reads the beginnings of the files, and the manifests.  Throws as stop_if_interrupted().
FarmStatus farm_status(const FarmFrames& frames, int threads);

// Says whether every frame is made and can be read.
bool is_complete(const FarmStatus& status);

std::string farm_page(const FarmFrames& frames, const FarmStatus& status);
// Returns one JSON object, without a newline after it.
std::string farm_json(const FarmFrames& frames, const FarmStatus& status, int indent);

}  // namespace domefall
