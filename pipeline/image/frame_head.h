// A FrameHead is what the file of a frame says of itself, its size and the fields that Domefall
// wrote.  They are read from the bytes, within bounds and without a decoder, since decoders ask for
// as much memory as a damaged header tells them to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pipeline/base/regular_file.h"

namespace domefall {

enum class FrameFormat { kExr, kPng, kTiff, kJpeg };

struct FrameHead {
  FrameFormat format{};
  std::int64_t width = 0, height = 0;  // as the file says, whatever its format allows
  int bits = 0;  // of a colour; 0 for an EXR, whose channels say theirs one by one

  // This says whether any field is Domefall's.  The texts of those that are missing are empty.
  bool ours = false;
  std::string title, projection, key;
  std::string frame;   // its number in the show, of a graded frame
  std::string digest;  // of the whole file (frame_check.h)

  // Here stand the digest's digits and, in a PNG, the chunk that holds them, from its name to its
  // checksum.  All three are counted in bytes from the file's beginning.
  std::uint64_t digest_at = 0, chunk_at = 0, checksum_at = 0;
};

// Reads the head of a file, or returns nothing if the file begins neither as EXR nor as PNG, TIFF
// or JPEG.  Throws DamagedFile if the part before the pixels is broken off or does not fit
// together, and throws as FileBytes::at.
std::optional<FrameHead> read_frame_head(const FileBytes& file);

// Says whether a file without a readable head may be the rest of a frame.  Such a file is empty,
// begins with zeros (as after a power cut), begins as a frame does, or holds a field of Domefall's.
// Many programs write files that begin as a JPEG, so that beginning counts only where a JPEG is
// wanted.  Throws as FileBytes::at.
bool may_be_rest_of_frame(const FileBytes& file, FrameFormat wanted);

// Returns a title as it stands in a description, where each line is a field.
std::string one_line(std::string title);

// These are the names of fields, which are attributes in an EXR and lines in the description of
// another file.
inline constexpr const char *kExrTitle = "showTitle", *kExrProjection = "projection",
                            *kExrKey = "frameKey", *kExrDigest = "fileDigest";
inline constexpr std::string_view kTitleLine = "show: ", kProjectionLine = "projection: ",
                                  kFrameLine = "frame: ", kKeyLine = "key: ",
                                  kDigestLine = "digest: ", kSoftwareLine = "software: Domefall";

// A PNG holds the description under this name, with the zero behind it.
inline constexpr std::string_view kPngKeyword{"Description\0", 12};

}  // namespace domefall
