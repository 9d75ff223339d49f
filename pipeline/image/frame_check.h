// A FrameCheck says what a file of a frame is: good, of another version, another's, damaged or
// missing.  It goes by what the file says of itself (frame_head.h) and by the digest of the whole
// file, which stands in the file itself, in a text that Domefall writes.  The digest's place is kept
// while the file is encoded, and filled in at the end.  So a file that was cut short, added to or
// changed in any bit is known to be damaged, whatever the decoders say of it.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/base/new_file.h"
#include "pipeline/image/frame_head.h"

namespace domefall {

// A frame of several files is in the first of these conditions that one of its files is in.
enum class FrameCondition {
  kUnreadable,  // it may be good: the system refuses, or it is no file
  kMissing,     // there is no such file
  kDamaged,     // not as it was written, or what is left of a frame
  kOther,  // a frame of another size, show or projection, or a file of another format or program
  kOlder,  // of the same show, but of another version of it
  kGood,
};
inline constexpr std::size_t kFrameConditions = 6;

// Says for people what frames in a condition are, as in "of another size, show or kind".
const char* words_of(FrameCondition condition);

// A WantedFrame is the frame that a run would write.
struct WantedFrame {
  std::string key;         // digest of everything that decides the frame
  std::string title;       // of the show
  std::string projection;  // by its name
  int width = 0, height = 0;
};

struct FrameCheck {
  FrameCondition condition = FrameCondition::kMissing;
  std::string reason = {};  // of kOther: what it is instead, as in "1024 x 1024 pixels"
  std::string digest = {};  // that the file has by its head
};

enum class CheckDepth {
  kHead,   // by its beginning alone
  kWhole,  // what claims to be good or another's is held against all of its bytes
};

// If the file's name ends in .exr, .png, .tif, .tiff, .jpg or .jpeg, that format is wanted.  An image
// without a digest, of which nobody can tell, is taken to be whole.  Never returns kUnreadable, but
// throws as FileBytes::open and FileBytes::at.
FrameCheck check_frame(const std::filesystem::path& path, const WantedFrame& wanted,
                       CheckDepth depth = CheckDepth::kWhole);

// Checks bytes that may lie elsewhere than in the file of that name.
FrameCheck check_frame(const FileBytes& bytes, const std::filesystem::path& path,
                       const WantedFrame& wanted, CheckDepth depth = CheckDepth::kWhole);

// Says whether the file has a digest and the bytes that the digest was taken of, all of which are
// read.  A missing file is not whole.  Throws as above.
bool is_whole(const std::filesystem::path& path);
bool is_whole(const FileBytes& file, const FrameHead& head);

// This stands in the place of the digest's 32 digits while it is not known.
inline constexpr std::string_view kBlankDigest = "00000000000000000000000000000000";

// Puts the digest into a file that an encoder has written whole.  It is XXH3, 128 bits, of all bytes.
// The digest itself counts as digits 0, and so does the checksum that follows it in a PNG, which
// read_frame_head() checks.  After an error of the disk, which commit() will throw, it does nothing.
// Throws std::logic_error if the encoder did not write the place that was kept.
void seal_frame(NewFile& file);

}  // namespace domefall
