#include "pipeline/image/read_graded.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/descriptor.h"
#include "pipeline/image/image_formats.h"

namespace domefall {
namespace {

void copy_bytes(const FileBytes& file, int to, const std::filesystem::path& path) {
  constexpr std::uint64_t kPiece = 1 << 20;
  for (std::uint64_t at = 0; at < file.size(); at += kPiece) {
    const std::string piece = file.at(at, std::min(kPiece, file.size() - at));
    for (std::size_t done = 0; done < piece.size();) {
      const ssize_t written = write(to, piece.data() + done, piece.size() - done);
      if (written < 0 && errno != EINTR) throw_file_error(path, errno);
      if (written > 0) done += static_cast<std::size_t>(written);
    }
  }
}

}  // namespace

FrameCondition read_graded(const std::filesystem::path& path, const WantedFrame& wanted,
                           GradedFrame& frame) {
  const auto file = FileBytes::open(path);
  if (!file) return FrameCondition::kMissing;
  const Descriptor memory(memfd_create("frame", MFD_CLOEXEC));
  if (memory.number() < 0) throw_file_error(path, errno);
  try {
    copy_bytes(*file, memory.number(), path);
  } catch (const DamagedFile&) {  // shortened meanwhile
    return FrameCondition::kDamaged;
  }
  const FileBytes bytes(memory.number(), path);
  const FrameCondition condition = examine_frame(bytes, path, wanted);
  if (condition != FrameCondition::kGood) return condition;
  try {
    const auto reader = image_formats().open(fmt::format("/proc/self/fd/{}", memory.number()));
    const ImageLayout& layout = reader->layout();
    if (layout.width != wanted.width || layout.height != wanted.height || layout.channels != 3)
      throw std::runtime_error("its pixels are not those of its header");
    frame = GradedFrame(wanted.width, wanted.height);
    reader->read(frame.row(0));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return condition;
}

}  // namespace domefall
