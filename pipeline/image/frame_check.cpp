#include "pipeline/image/frame_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "pipeline/base/digest.h"
#include "pipeline/image/encode/picture_writers.h"

namespace domefall {
namespace {

constexpr std::uint64_t kBlock = std::uint64_t{1} << 20, kChecksum = 4;

// Puts the digit 0 where the `count` bytes at `place` of the file overlap a block that begins at
// `begin`.
void blank(std::string& block, std::uint64_t begin, std::uint64_t place, std::uint64_t count) {
  const std::uint64_t from = std::max(place, begin),
                      to = std::min(place + count, begin + block.size());
  if (from < to)
    std::fill(block.begin() + static_cast<std::ptrdiff_t>(from - begin),
              block.begin() + static_cast<std::ptrdiff_t>(to - begin), '0');
}

std::string frame_digest(const FileBytes& file, const FrameHead& head) {
  Digest digest;
  for (std::uint64_t at = 0; at < file.size(); at += kBlock) {
    std::string block = file.at(at, std::min(kBlock, file.size() - at));
    blank(block, at, head.digest_at, kBlankDigest.size());
    if (head.format == FrameFormat::kPng) blank(block, at, head.checksum_at, kChecksum);
    digest.add_piece(block);
  }
  return digest.hex();
}

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

FrameCondition headless_condition(const std::filesystem::path& path, const FileBytes& file) {
  try {
    return may_be_rest_of_frame(file, format_of(path)) ? FrameCondition::kDamaged
                                                       : FrameCondition::kOther;
  } catch (const DamagedFile&) {  // shortened meanwhile
    return FrameCondition::kOther;
  }
}

FrameCheck check_head(const std::filesystem::path& path, const FileBytes& file,
                      const std::optional<FrameHead>& head, const WantedFrame& wanted) {
  if (!head) return {headless_condition(path, file), "a file that is not Domefall's"};
  if (auto other = difference(path, *head, wanted))
    return {FrameCondition::kOther, std::move(*other), head->digest};
  const bool same = head->key == wanted.key && head->digest.size() == kBlankDigest.size();
  return {same ? FrameCondition::kGood : FrameCondition::kOlder, {}, head->digest};
}

}  // namespace

const char* words_of(FrameCondition condition) {
  constexpr const char* kWords[kFrameConditions] = {
      "cannot be read",
      "missing",
      "damaged",
      "of another size, show or kind",
      "of another version of the show or of its grade",
      "good"};
  return kWords[static_cast<std::size_t>(condition)];
}

FrameCheck check_frame(const FileBytes& bytes, const std::filesystem::path& path,
                       const WantedFrame& wanted, CheckDepth depth) {
  const auto head = head_of(bytes);
  FrameCheck found = check_head(path, bytes, head, wanted);
  const bool keeps = found.condition == FrameCondition::kGood ||
                     (found.condition == FrameCondition::kOther && !found.digest.empty());
  if (depth == CheckDepth::kWhole && keeps && !is_whole(bytes, *head))
    found.condition = FrameCondition::kDamaged;
  return found;
}

FrameCheck check_frame(const std::filesystem::path& path, const WantedFrame& wanted,
                       CheckDepth depth) {
  const auto file = FileBytes::open(path);
  return file ? check_frame(*file, path, wanted, depth) : FrameCheck{};
}

bool is_whole(const FileBytes& file, const FrameHead& head) {
  try {
    return !head.digest.empty() && frame_digest(file, head) == head.digest;
  } catch (const DamagedFile&) {  // shortened meanwhile
    return false;
  }
}

bool is_whole(const std::filesystem::path& path) {
  const auto file = FileBytes::open(path);
  const auto head = file ? head_of(*file) : std::nullopt;
  return head && is_whole(*file, *head);
}

void seal_frame(NewFile& file) {
  const std::uint64_t end = file.size();
  const int written = file.flush();
  if (file.failed()) return;
  const FileBytes bytes(written, "a frame in the making");
  const auto head = read_frame_head(bytes);
  if (!head || head->digest != kBlankDigest)
    throw std::logic_error("an encoder has left out the place of the digest");
  const std::string digest = frame_digest(bytes, *head);
  file.seek(head->digest_at);
  file.write(digest);
  if (head->format == FrameFormat::kPng) {
    std::string chunk = bytes.at(head->chunk_at, head->checksum_at - head->chunk_at);
    chunk.replace(head->digest_at - head->chunk_at, digest.size(), digest);
    file.seek(head->checksum_at);
    file.write(png_checksum(chunk));
  }
  file.seek(end);
}

}  // namespace domefall
