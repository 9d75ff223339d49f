// This check says what is wrong in a finished delivery.  It looks at the folder alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

// Numbers are those in the names of the frames.  Files are named by their paths below the folder.
struct DeliveryFaults {
  std::vector<std::string> whole;  // sentences about the delivery as a whole
  std::vector<int> missing_frames, damaged_frames;
  std::vector<int> repeated_frames;  // the same file as an earlier frame
  std::vector<int> other_frames;     // not of the size, depth or kind that metadata.json says
  std::vector<std::string> missing_files, changed_files, extra_files;
  std::vector<std::string> left_behind;  // by systems and file managers, which is no fault

  bool none() const;
};

// Reads every file.  In a good delivery every sum on the list is that of its file, nothing else is
// there but what others leave behind (folder_files.h), and the frames are all of those from the
// first to the last, each once, whole and alike.  Throws InputError if there is no such folder, and
// TemporaryError where a file cannot be read.
DeliveryFaults check_delivery(const std::filesystem::path& folder, int threads);

}  // namespace domefall
