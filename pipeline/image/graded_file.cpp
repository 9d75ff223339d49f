#include "pipeline/image/graded_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/image/encode/picture_writers.h"
#include "pipeline/image/frame_check.h"
#include "pipeline/image/frame_head.h"

namespace domefall {
namespace {

// There is one line for each field.
std::string description_of(const GradedInfo& info) {
  return fmt::format("{}{}\n{}{}\n{}{}\ndisplay: {}\nview: {}\nsoftware: {}\n{}{}\n{}{}\n",
                     kTitleLine, one_line(info.title), kFrameLine, info.frame, kProjectionLine,
                     info.projection, one_line(info.display), one_line(info.view), info.software,
                     kKeyLine, info.key, kDigestLine, kBlankDigest);
}

void write_picture(ByteSink& sink, const RowPicture& picture, const GradedInfo& info,
                   const GradedFormat& format) {
  const std::string description = description_of(info);
  const std::string profile = info.colour ? icc_profile(*info.colour) : std::string();
  const OpaqueColumns opaque = format.alpha ? info.opaque : nullptr;
  switch (format.kind) {
    case GradedKind::kPng16:
    case GradedKind::kPng8: {
      PngHead head{format.kind == GradedKind::kPng8, info.frame, {}, opaque};
      if (info.colour) head.chunks = png_colour_chunks(*info.colour);
      if (info.pixel_aspect != 1) head.chunks.push_back(png_pixel_aspect(info.pixel_aspect));
      head.chunks.push_back({"tEXt", std::string(kPngKeyword) + description});
      return write_png(sink, picture, head);
    }
    case GradedKind::kTiff16:
    case GradedKind::kTiff8:
      return write_tiff(sink, picture,
                        {format.kind == GradedKind::kTiff8, info.frame, description, profile,
                         opaque, info.pixel_aspect});
    case GradedKind::kJpeg:
      if (description.size() > kLongestJpegComment)
        throw InputError(fmt::format(
            "the title of the show has {} bytes, and the comment of a JPEG has room for {}",
            info.title.size(), kLongestJpegComment - (description.size() - info.title.size())));
      return write_jpeg(sink, picture,
                        {format.quality, info.frame, profile, description, info.pixel_aspect});
  }
}

}  // namespace

void write_graded(const std::filesystem::path& path, const RowPicture& picture,
                  const GradedInfo& info, const GradedFormat& format) {
  NewFile made(path);
  write_picture(made, picture, info, format);
  seal_frame(made);
  made.commit();
}

void write_graded(const std::filesystem::path& path, const GradedFrame& frame,
                  const GradedInfo& info, const GradedFormat& format) {
  const auto rows = [&frame](int first, int end, unsigned short* rgb) {
    std::copy(frame.row(first), frame.row(end), rgb);
  };
  write_graded(path, {frame.width, frame.height, rows}, info, format);
}

const char* extension_of(GradedKind kind) {
  if (kind == GradedKind::kJpeg) return "jpg";
  return kind == GradedKind::kPng16 || kind == GradedKind::kPng8 ? "png" : "tif";
}

std::string format_id(const GradedFormat& format) {
  if (format.kind == GradedKind::kJpeg) return fmt::format("JPEG {}", format.quality);
  const bool eight = format.kind == GradedKind::kPng8 || format.kind == GradedKind::kTiff8;
  return fmt::format("{}{}", eight ? "8 bits" : "", format.alpha ? " alpha" : "");
}

GradedFormat format_by_name(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".png") return {GradedKind::kPng16};
  if (extension == ".tif" || extension == ".tiff") return {GradedKind::kTiff16};
  if (extension == ".jpg" || extension == ".jpeg") return {GradedKind::kJpeg};
  throw InputError(path.string() + ": graded frames are .png, .tif, .tiff or .jpg");
}

}  // namespace domefall
