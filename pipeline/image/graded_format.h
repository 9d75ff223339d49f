// A GradedFormat is one of the kinds of file that a graded frame can be.
#pragma once

#include <filesystem>
#include <string>

namespace domefall {

enum class GradedKind { kPng16, kPng8, kJpeg, kTiff16, kTiff8 };

struct GradedFormat {
  GradedKind kind = GradedKind::kPng16;
  int quality = 95;  // of a JPEG, 1 to 100

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

}  // namespace domefall
