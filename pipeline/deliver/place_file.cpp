#include "pipeline/deliver/place_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/descriptor.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/new_file.h"
#include "pipeline/image/regular_file.h"
#include "pipeline/image/temporary_file.h"

namespace domefall {

namespace fs = std::filesystem;

void copy_whole_file(const fs::path& from, const fs::path& to) {
  RegularFile source(from);
  NewFile made(to);
  std::vector<char> block(std::size_t{1} << 20);
  while (const std::size_t count = source.read(block.data(), block.size()))
    made.write({block.data(), count});
  made.commit();
}

void link_or_copy_file(const fs::path& from, const fs::path& to) {
  if (unlink(to.c_str()) != 0 && errno != ENOENT) throw_file_error(to, errno);
  // A symbolic link at `from` is followed, since a hard link to it would lead away from the
  // delivery.
  if (linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
  switch (errno) {
    case EXDEV:       // another file system
    case EPERM:       // one without hard links, or another user's file
    case EMLINK:      // as many as it may have
    case EOPNOTSUPP:  // as above, on some systems
    case ENOSYS:
      return copy_whole_file(from, to);
    default:
      throw_file_error(to, errno);
  }
}

void make_delivery_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    const std::string what = folder.string() + ": the folder cannot be made: " + error.message();
    if (error.value() == ENOTDIR || error.value() == EEXIST || error.value() == ENAMETOOLONG ||
        error.value() == ELOOP)
      throw InputError(what);
    throw TemporaryError(what);
  }
  sweep_temporaries(folder);
}

void flush_folder(const fs::path& folder) {
  const Descriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() < 0) throw_file_error(folder, errno);
  // Some file systems cannot flush a folder, and say so by these errors.
  if (fsync(opened.number()) != 0 && errno != EINVAL && errno != ENOTSUP)
    throw_file_error(folder, errno);
}

}  // namespace domefall
