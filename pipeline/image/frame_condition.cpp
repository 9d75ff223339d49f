#include "pipeline/image/frame_condition.h"

#include <fmt/format.h>

#include <optional>

#include "pipeline/image/frame_seal.h"

namespace domefall {
namespace {

FrameFormat format_of(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".exr") return FrameFormat::kExr;
  if (extension == ".jpg" || extension == ".jpeg") return FrameFormat::kJpeg;
  return extension == ".png" ? FrameFormat::kPng : FrameFormat::kTiff;
}

const char* format_name(FrameFormat format) {
  switch (format) {
    case FrameFormat::kExr:
      return "an OpenEXR file";
    case FrameFormat::kPng:
      return "a PNG";
    case FrameFormat::kJpeg:
      return "a JPEG";
    case FrameFormat::kTiff:
      break;
  }
  return "a TIFF";
}

// Returns nothing for what is damaged.
std::optional<FrameHead> head_of(const FileBytes& file) {
  try {
    return read_frame_head(file);
  } catch (const DamagedFile&) {
    return std::nullopt;
  }
}

// Returns what the file is where that is not what is wanted, or nothing if it may be of the same
// show.
std::optional<std::string> difference(const std::filesystem::path& path, const FrameHead& head,
                                      const WantedFrame& wanted) {
  if (!head.ours) return "an image that is not Domefall's";
  if (head.format != format_of(path)) return format_name(head.format);
  if (head.width != wanted.width || head.height != wanted.height)
    return fmt::format("{} x {} pixels", head.width, head.height);
  if (one_line(head.title) != one_line(wanted.title))
    return fmt::format("of the show '{}'", one_line(head.title));
  if (!head.projection.empty() && head.projection != wanted.projection)
    return fmt::format("of the projection {}", head.projection);
  return std::nullopt;
}

bool has_right_digest(const FileBytes& file, const FrameHead& head) {
  try {
    return frame_digest(file, head) == head.digest;
  } catch (const DamagedFile&) {  // shortened meanwhile
    return false;
  }
}

FrameCondition headless_condition(const std::filesystem::path& path, const FileBytes& file) {
  try {
    return may_be_rest_of_frame(file, format_of(path)) ? FrameCondition::kDamaged
                                                       : FrameCondition::kOther;
  } catch (const DamagedFile&) {  // shortened meanwhile
    return FrameCondition::kOther;
  }
}

FrameCondition claimed_condition(const std::filesystem::path& path, const FileBytes& file,
                                 const std::optional<FrameHead>& head, const WantedFrame& wanted) {
  if (!head) return headless_condition(path, file);
  if (difference(path, *head, wanted)) return FrameCondition::kOther;
  const bool same = head->key == wanted.key && head->digest.size() == kBlankDigest.size();
  return same ? FrameCondition::kGood : FrameCondition::kOlder;
}

}  // namespace

FrameCondition claimed_condition(const std::filesystem::path& path, const WantedFrame& wanted) {
  const auto file = FileBytes::open(path);
  return file ? claimed_condition(path, *file, head_of(*file), wanted) : FrameCondition::kMissing;
}

bool is_whole(const std::filesystem::path& path) {
  const auto file = FileBytes::open(path);
  const auto head = file ? head_of(*file) : std::nullopt;
  return head && !head->digest.empty() && has_right_digest(*file, *head);
}

FrameCondition examine_frame(const FileBytes& bytes, const std::filesystem::path& path,
                             const WantedFrame& wanted) {
  const auto head = head_of(bytes);
  const FrameCondition claimed = claimed_condition(path, bytes, head, wanted);
  const bool keeps = claimed == FrameCondition::kGood ||
                     (claimed == FrameCondition::kOther && head && !head->digest.empty());
  return !keeps || has_right_digest(bytes, *head) ? claimed : FrameCondition::kDamaged;
}

FrameCondition examine_frame(const std::filesystem::path& path, const WantedFrame& wanted) {
  const auto file = FileBytes::open(path);
  return file ? examine_frame(*file, path, wanted) : FrameCondition::kMissing;
}

std::string describe_difference(const std::filesystem::path& path, const WantedFrame& wanted) {
  const auto file = FileBytes::open(path);
  const auto head = file ? head_of(*file) : std::nullopt;
  return head ? difference(path, *head, wanted).value_or("") : "a file that is not Domefall's";
}

}  // namespace domefall
