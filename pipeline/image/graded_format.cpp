#include "pipeline/image/graded_format.h"

#include <fmt/format.h>

#include "pipeline/image/errors.h"

namespace domefall {

const char* extension_of(GradedKind kind) {
  switch (kind) {
    case GradedKind::kPng16:
    case GradedKind::kPng8:
      return "png";
    case GradedKind::kJpeg:
      return "jpg";
    case GradedKind::kTiff16:
    case GradedKind::kTiff8:
      break;
  }
  return "tif";
}

std::string format_id(const GradedFormat& format) {
  switch (format.kind) {
    case GradedKind::kPng16:
    case GradedKind::kTiff16:
      return {};
    case GradedKind::kPng8:
    case GradedKind::kTiff8:
      return "8 bits";
    case GradedKind::kJpeg:
      break;
  }
  return fmt::format("JPEG {}", format.quality);
}

GradedFormat format_by_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".png") return {GradedKind::kPng16};
  if (extension == ".tif" || extension == ".tiff") return {GradedKind::kTiff16};
  if (extension == ".jpg" || extension == ".jpeg") return {GradedKind::kJpeg};
  throw InputError(path.string() + ": graded frames are .png, .tif, .tiff or .jpg");
}

}  // namespace domefall
