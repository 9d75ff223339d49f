// A FileFinding is what one file of a frame is found to be, at a glance or by all of its bytes.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/farm/manifest.h"
#include "pipeline/image/frame_condition.h"

namespace domefall {

// An ExpectedFile is one that a folder of frames is to hold.
struct ExpectedFile {
  int frame = 0;
  std::filesystem::path path;
  std::string name;  // below the folder of the frames
  WantedFrame wanted;
};

struct FileFinding {
  FrameCondition condition = FrameCondition::kMissing;
  std::string unreadable;  // why it cannot be read; the rest is then unknown
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

}  // namespace domefall
