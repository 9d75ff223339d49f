// The digest of a whole frame file stands in the file itself, in a text that Domefall writes.  Its
// place is kept while the file is encoded, and filled in at the end.  So a file that was cut short,
// added to or changed in any bit is known to be damaged, whatever the decoders say of it.
#pragma once

#include <string>

#include "pipeline/image/frame_head.h"
#include "pipeline/image/new_file.h"

namespace domefall {

// This stands in the place of the digest's 32 digits while it is not known.
inline constexpr std::string_view kBlankDigest = "00000000000000000000000000000000";

// Returns XXH3, 128 bits, of all bytes.  The digest itself counts as digits 0, and so does the
// checksum that follows it in a PNG, which read_frame_head() checks.  It is as quick as the disk.
// Throws as FileBytes::at.
std::string frame_digest(const FileBytes& file, const FrameHead& head);

// Puts the digest into a file that an encoder has written whole.  After an error of the disk, which
// commit() will throw, it does nothing.  Throws std::logic_error if the encoder did not write the
// place that was kept.
void seal_frame(NewFile& file);

}  // namespace domefall
