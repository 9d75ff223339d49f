#include "pipeline/image/frame_seal.h"

#include <algorithm>
#include <stdexcept>

#include "pipeline/image/digest.h"
#include "pipeline/image/encode/png_writer.h"

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

}  // namespace

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
