#include "pipeline/image/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <random>
#include <string>

#include "pipeline/image/errors.h"
#include "pipeline/image/new_file.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".tmp";
constexpr auto kForeignAge = std::chrono::hours(24);

std::string host_name() {
  char name[256] = {};
  if (gethostname(name, sizeof name - 1) != 0) return "unknown";
  std::string host(name);
  for (char& c : host)
    if (c == '.' || c == '/') c = '-';
  return host;
}

class Descriptor {
 public:
  // Failures are told under the name that the user knows.
  Descriptor(const fs::path& path, int flags, const fs::path& known_as)
      : path_(known_as), fd_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (fd_ < 0) throw_file_error(path_, errno);
  }
  ~Descriptor() { close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  void flush() const {
    // Some file systems cannot flush a folder and say so; their renames are durable or nobody's.
    if (fsync(fd_) != 0 && errno != EINVAL && errno != ENOTSUP) throw_file_error(path_, errno);
  }

 private:
  const fs::path& path_;
  int fd_;
};

struct Owner {
  std::string host;
  pid_t process;
};

// From .NAME.<host>.<pid>.<nonce>.tmp; nothing if it is no such name.
std::optional<Owner> owner_of(const std::string& name) {
  if (!name.starts_with('.') || !name.ends_with(kSuffix)) return std::nullopt;
  const std::string rest = name.substr(0, name.size() - kSuffix.size());
  const auto nonce = rest.rfind('.');
  if (nonce == std::string::npos || nonce == 0) return std::nullopt;
  const auto process = rest.rfind('.', nonce - 1);
  if (process == std::string::npos || process == 0) return std::nullopt;
  const auto host = rest.rfind('.', process - 1);
  if (host == std::string::npos || host == 0) return std::nullopt;
  const std::string digits = rest.substr(process + 1, nonce - process - 1);
  if (digits.empty() || digits.size() > 9 ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    return std::nullopt;
  return Owner{rest.substr(host + 1, process - host - 1), std::stoi(digits)};
}

// A zombie has a number and runs no more; where nothing reaps it, as in some containers, it stays
// one.
bool is_zombie(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(stat, text);
  const auto name_end = text.rfind(')');  // the name itself may hold anything
  return name_end != std::string::npos && text.compare(name_end + 1, 2, " Z") == 0;
}

bool is_running(pid_t process) {
  return (kill(process, 0) == 0 || errno != ESRCH) && !is_zombie(process);
}

bool is_abandoned(const fs::directory_entry& entry, const Owner& owner) {
  if (owner.host == host_name()) return !is_running(owner.process);
  std::error_code error;
  const auto written = entry.last_write_time(error);
  return !error && fs::file_time_type::clock::now() - written > kForeignAge;
}

}  // namespace

// Unique among the writers of this process and, by host and process number, among all; the random
// part tells this process from one of an earlier boot with the same number.
fs::path temporary_for(const fs::path& path) {
  static const unsigned start = std::random_device{}();
  static std::atomic<unsigned> count{0};
  const std::string tail = "." + host_name() + "." + std::to_string(getpid()) + "." +
                           std::to_string(start) + "-" + std::to_string(count++) +
                           std::string(kSuffix);
  // The file's own name is cut where the whole would pass the file systems' 255 bytes.
  std::string name = path.filename().string();
  if (name.size() + tail.size() > 250) name.resize(250 - tail.size());
  return path.parent_path() / ("." + name + tail);
}

void put_in_place(const fs::path& temporary, const fs::path& path) {
  const fs::path folder = path.parent_path().empty() ? "." : path.parent_path();
  if (rename(temporary.c_str(), path.c_str()) != 0) throw_file_error(path, errno);
  Descriptor(folder, O_RDONLY | O_DIRECTORY, folder).flush();
}

void throw_file_error(const fs::path& path, int error) {
  const std::string what = path.string() + ": " + std::strerror(error);
  switch (error) {
    case ENOENT:
    case ENOTDIR:
    case EISDIR:
    case EACCES:
    case EPERM:
    case EROFS:
    case ENAMETOOLONG:
    case ELOOP:
      throw InputError(what);
    default:
      throw TemporaryError(what);
  }
}

void write_atomically(const fs::path& path, std::string_view contents) {
  NewFile file(path);
  file.write(contents);
  file.commit();
}

int sweep_temporaries(const fs::path& folder) {
  int removed = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto owner = owner_of(entry->path().filename().string());
    if (owner && is_abandoned(*entry, *owner) && unlink(entry->path().c_str()) == 0) ++removed;
  }
  return removed;
}

}  // namespace domefall
