#include "pipeline/image/read_graded.h"

#include <algorithm>
#include <stdexcept>

#include "pipeline/base/child_program.h"
#include "pipeline/image/image_formats.h"

namespace domefall {
namespace {

void copy_bytes(const FileBytes& file, const MemoryFile& to) {
  constexpr std::uint64_t kPiece = 1 << 20;
  for (std::uint64_t at = 0; at < file.size(); at += kPiece)
    to.append(file.at(at, std::min(kPiece, file.size() - at)));
}

}  // namespace

FrameCondition read_graded(const std::filesystem::path& path, const WantedFrame& wanted,
                           GradedFrame& frame) {
  const auto file = FileBytes::open(path);
  if (!file) return FrameCondition::kMissing;
  const MemoryFile memory(path.string());
  try {
    copy_bytes(*file, memory);
  } catch (const DamagedFile&) {  // shortened meanwhile
    return FrameCondition::kDamaged;
  }
  const FileBytes bytes(memory.number(), path);
  const FrameCondition condition = check_frame(bytes, path, wanted).condition;
  if (condition != FrameCondition::kGood) return condition;
  try {
    const auto reader = image_formats().open(memory.path(), PixelEncoding::kStored);
    const ImageLayout& layout = reader->layout();
    if (layout.width != wanted.width || layout.height != wanted.height || layout.channels < 3)
      throw std::runtime_error("its pixels are not those of its header");
    frame = GradedFrame(wanted.width, wanted.height);
    reader->read(frame.row(0));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return condition;
}

}  // namespace domefall
