#include "pipeline/preview/file_watch.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

// A link and the file that it leads to may each be replaced.
FileWatch::FileWatch(const std::filesystem::path& file)
    : inotify_(inotify_init1(IN_CLOEXEC | IN_NONBLOCK)), file_(file) {
  std::error_code unreadable;
  const std::filesystem::path target = std::filesystem::weakly_canonical(file, unreadable);
  for (const std::filesystem::path& watched : {file, unreadable ? file : target}) {
    names_.insert(watched.filename());
    if (inotify_.number() < 0 || inotify_add_watch(inotify_.number(), folder_of(watched).c_str(),
                                                   IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE |
                                                       IN_DELETE_SELF | IN_MOVE_SELF) < 0)
      throw TemporaryError(fmt::format("{}: changes cannot be watched for: {}", file.string(),
                                       std::strerror(errno)));
  }
}

bool FileWatch::wait(int milliseconds) {
  pollfd ready{inotify_.number(), POLLIN, 0};
  if (poll(&ready, 1, milliseconds) <= 0) return false;
  alignas(inotify_event) std::array<char, 4096> events;
  bool written = false;
  for (;;) {
    const ssize_t count = read(inotify_.number(), events.data(), events.size());
    if (count <= 0) return written;
    for (ssize_t at = 0; at < count;) {
      inotify_event event;
      std::memcpy(&event, events.data() + at, sizeof event);
      const char* name = events.data() + at + sizeof event;
      if ((event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED)) != 0)
        throw TemporaryError(file_.string() + ": its folder is no longer there");
      const bool named = event.len > 0 && names_.contains(name);
      // A file that is created is told of again when it is closed, but a link is whole.
      const bool whole = (event.mask & IN_CREATE) == 0 || std::filesystem::is_symlink(file_);
      // After an overflow nobody knows what was written.
      if ((event.mask & IN_Q_OVERFLOW) != 0 || (named && whole)) written = true;
      at += static_cast<ssize_t>(sizeof event + event.len);
    }
  }
}

}  // namespace domefall
