// What `domefall farm status` says, for people and for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/cli/farm_frames.h"

namespace domefall {

// The state of a folder at one moment.
struct FarmStatus {
  FolderFindings found;
  Manifest manifest;
  std::vector<std::string> foreign;
  FrameSurvey invalidated;
  std::optional<double> frames_per_second;
  std::vector<SlowFrame> slowest;
  std::vector<FailedChunk> failed;
  std::string conclusion;  // FarmFrames::conclusion()
  double now_s = 0;        // since 1970
};

// Looks at the files at a glance, and reads the manifests.  Throws as read_manifest and
// stop_if_interrupted.
FarmStatus farm_status(const FarmFrames& frames, int threads);

// Whether nothing is left to do.
bool is_complete(const FarmStatus& status);

std::string farm_page(const FarmFrames& frames, const FarmStatus& status);
// One object, without the line's end.
std::string farm_json(const FarmFrames& frames, const FarmStatus& status, int indent);

}  // namespace domefall
