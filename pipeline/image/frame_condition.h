// A FrameCondition says whether a frame on the disk can be kept, and whether it may be made again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "pipeline/image/frame_head.h"

namespace domefall {

enum class FrameCondition {
  kMissing,  // there is no such file
  kDamaged,  // not as it was written, or what is left of a frame
  kOther,    // a frame of another size, show or projection, or a file of another format or program
  kOlder,    // of the same show, but of another version of it, or written without a digest
  kGood,
};

// A WantedFrame is the frame that a run would write.
struct WantedFrame {
  std::string key;         // digest of everything that decides the frame
  std::string title;       // of the show
  std::string projection;  // by its name
  int width = 0, height = 0;
};

// Returns what a file says that it is, of which only the beginning is read.  If its name ends in
// .exr, .png, .tif, .tiff, .jpg or .jpeg, that format is wanted.  Throws as FileBytes::open and
// FileBytes::at.
FrameCondition claimed_condition(const std::filesystem::path& path, const WantedFrame& wanted);

// Says whether the file has a digest and the bytes that the digest was taken of, all of which are
// read.  A missing file is not whole.  Throws as above.
bool is_whole(const std::filesystem::path& path);

// Returns the claimed condition, held against the whole file where that is kGood or kOther.  An
// image without a digest, of which nobody can tell, is taken to be whole.  Throws as above.
FrameCondition examine_frame(const std::filesystem::path& path, const WantedFrame& wanted);

// Returns the same of bytes that may lie elsewhere than in the file of that name.
FrameCondition examine_frame(const FileBytes& bytes, const std::filesystem::path& path,
                             const WantedFrame& wanted);

// Says for people what makes a frame another one than is wanted, as in "1024 x 1024 pixels".
// Throws as above.
std::string describe_difference(const std::filesystem::path& path, const WantedFrame& wanted);

}  // namespace domefall
