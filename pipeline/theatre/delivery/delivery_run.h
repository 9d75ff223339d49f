// This file makes the folder that festivals and dome operators ask for, out of finished frames.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/show.h"
#include "pipeline/theatre/sound/sound.h"

namespace domefall {

// What helps where frames are another show's (GradedFrames::check).
inline constexpr const char* kOtherFramesHint = "another --from or --size may fit them";

struct DeliveryRun {
  const Show& show;            // as large as its frames are
  std::filesystem::path from;  // holds graded/NAME_00000.png
  std::filesystem::path out;
  std::optional<int> bits;  // of a colour; none leaves the frames as they are
  std::string name;         // a NamePattern; empty for the show's own name
  Sound sound;              // of show_sound()
  std::vector<std::filesystem::path> subtitles;
  bool leader = false;
  int threads = 1;
};

// Makes the delivery.  Every frame and file is held against what it should be before any is
// written.  The list of checksums comes last, and INCOMPLETE.txt is there until then.  Another run
// keeps what is good and makes the rest.  Throws InputError for frames and subtitles that do not
// fit, for names that are refused, and for a folder that holds anything else.  Throws
// TemporaryError as GradedFrames::check(), and where the disk fails.
void run_delivery(const DeliveryRun& run);

// Throws InputError for what run_delivery() would refuse however good the frames will be, such as a
// name, a sound or the folder.
void check_delivery_folder(const DeliveryRun& run);

}  // namespace domefall
