#include "pipeline/render/file_stamp.h"

#include <sys/stat.h>

namespace domefall {

FileStamp::FileStamp(const std::filesystem::path& file) {
  struct stat status {};
  // A path without a file keeps a stamp of zeros.
  if (stat(file.c_str(), &status) != 0) return;
  // An inode's number is one of its device, so that both are needed.
  device = status.st_dev;
  number = status.st_ino;
  size = static_cast<std::uint64_t>(status.st_size);
  written_s = status.st_mtim.tv_sec, written_ns = status.st_mtim.tv_nsec;
  changed_s = status.st_ctim.tv_sec, changed_ns = status.st_ctim.tv_nsec;
}

}  // namespace domefall
