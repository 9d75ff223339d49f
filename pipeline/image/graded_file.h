// Graded frames on the disk serve projectors and encoders.  They are RGB of 8 or 16 bits as PNG,
// TIFF or JPEG, the first two with an alpha where it is asked for.  The fields of GradedInfo and the digest of the file (frame_check.h) are lines
// "name: value" of the file's description, which in a JPEG is its comment.  The meaning of the
// codes is written where readers look for it.  A PNG has it in chunks, and the others in an ICC
// profile.  The same frame has the same bytes wherever and whenever it is written, and with any
// number of threads (set_file_threads in frame_file.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/image/encode/display_colour.h"
#include "pipeline/image/encode/row_source.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

// A GradedFormat is one of the kinds of file that a graded frame can be.
enum class GradedKind { kPng16, kPng8, kJpeg, kTiff16, kTiff8 };

struct GradedFormat {
  GradedKind kind = GradedKind::kPng16;
  int quality = 95;    // of a JPEG, 1 to 100
  bool alpha = false;  // not of a JPEG

  bool operator==(const GradedFormat&) const = default;
};

// Returns png, jpg or tif.
const char* extension_of(GradedKind kind);

// Returns what tells files apart that frames of the same key are written into.  It is empty for
// those of 16 bits, which hold all of the grade.
std::string format_id(const GradedFormat& format);

// Returns the format that a file's extension asks for.  This is PNG (.png) or TIFF (.tif, .tiff) of
// 16 bits, or JPEG (.jpg, .jpeg).  Throws InputError for any other extension.
GradedFormat format_by_name(const std::filesystem::path& path);

struct GradedInfo {
  std::string key{};  // digest of everything that decides this frame and its grade, hexadecimal
  std::string title{};
  int frame = 0;
  std::string display{}, view{};  // of the OpenColorIO configuration
  std::string software{};
  std::string projection{};
  std::optional<DisplayColour> colour{};  // of the display, where that is known
  OpaqueColumns opaque{};                 // of the projection, where the format has an alpha
  double pixel_aspect = 1;                // width of a pixel over its height
};

// Writes a frame under its final name when it is complete, while its rows are made.  Throws as
// TemporaryFile does, throws what the rows throw, and throws InputError for a title that a JPEG has
// no room for.
void write_graded(const std::filesystem::path& path, const RowPicture& picture,
                  const GradedInfo& info, const GradedFormat& format);

// Writes a frame that is whole.
void write_graded(const std::filesystem::path& path, const GradedFrame& frame,
                  const GradedInfo& info, const GradedFormat& format);

}  // namespace domefall
