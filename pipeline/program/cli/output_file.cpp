#include "pipeline/program/cli/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/temporary_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// Returns the number of this process's descriptor that a path such as /proc/self/fd/1 names, or
// else -1.
int own_descriptor(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.parent_path(), error);
  if (error || folder != fs::canonical("/proc/self/fd", error) || error) return -1;
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
  return wrong == std::errc() && end == name.data() + name.size() ? number : -1;
}

bool is_own(const fs::path& path) { return own_descriptor(path) >= 0; }

// Opens a pipe or a device.  Waits a second for a pipe's reader, who may have been started together
// with this program.
int open_stream(const fs::path& path, const fs::path& named) {
  constexpr int kMostTries = 100;
  for (int tries = 0; tries < kMostTries; ++tries) {
    const int opened = open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (opened >= 0) {
      fcntl(opened, F_SETFL, 0);  // writing has to wait for the reader
      return opened;
    }
    if (errno != ENXIO) throw_file_error(named, errno);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw TemporaryError(named.string() + ": nobody reads this pipe");
}

[[noreturn]] void refuse(const fs::path& named, const char* what) {
  throw InputError(
      fmt::format("{}: is {}, which is not written into; name a file", named.string(), what));
}

// Returns a descriptor of what is not replaced but written into, or -1 for a file.
int stream_at(const fs::path& path, const fs::path& named) {
  if (const int own = own_descriptor(path); own >= 0) {
    const int copy = fcntl(own, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) throw_file_error(named, errno);
    return copy;
  }
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return -1;
  switch (status.st_mode & S_IFMT) {
    case S_IFDIR:
      refuse(named, "a folder");
    case S_IFBLK:
      refuse(named, "a disk");
    case S_IFSOCK:
      refuse(named, "a socket");
    case S_IFREG:
      return -1;
    default:
      return open_stream(path, named);
  }
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) : named_(path), path_(end_of_links(path, is_own)) {
  if (!path.has_filename()) throw InputError("'" + path.string() + "' names no file to write");
  stream_ = stream_at(path_, named_);
  if (stream_ >= 0) {
    scratch_.emplace();
    path_ = *scratch_ / named_.filename();
    return;
  }
  if (path_ != named_)
    say(fmt::format("{}: a link; the file is {}", named_.string(), path_.string()));
  sweep_temporaries(path_.parent_path().empty() ? "." : path_.parent_path());
}

OutputFile::~OutputFile() {
  if (stream_ >= 0) close(stream_);
}

void OutputFile::finish() {
  if (stream_ < 0) return;
  RegularFile content(path_);
  std::fflush(stdout);  // standard output may lead to the same place
  std::vector<char> piece(std::size_t{64} << 10);
  while (const std::size_t count = content.read(piece.data(), piece.size()))
    if (!write_all(stream_, {piece.data(), count})) throw_file_error(named_, errno);
}

void write_output(const fs::path& path, std::string_view contents) {
  OutputFile out(path);
  write_atomically(out.path(), contents);
  out.finish();
}

void refuse_overwriting(const fs::path& out, const fs::path& input) {
  std::error_code neither;  // one of them does not exist
  if (fs::equivalent(out, input, neither) && !neither)
    throw InputError("--out " + out.string() + ": that is the file to be read; name another");
}

}  // namespace domefall
