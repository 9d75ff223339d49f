#include "pipeline/base/writer_id.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <ctime>
#include <fstream>
#include <random>
#include <sstream>

namespace domefall {
namespace {

// This is in seconds.  A job that is suspended over a weekend goes on writing after it.
constexpr std::time_t kBeyondDoubt = std::time_t{7} * 24 * 3600;

template <class Number>
bool read_whole_number(std::string_view text, Number& number, int base) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return error == std::errc() && end == text.data() + text.size();
}

// Returns 0 where it cannot be read.
std::uint64_t boot_of_this_machine() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string text, digits;
  std::getline(file, text);
  for (const char c : text)
    if (c != '-' && digits.size() < 16) digits += c;
  std::uint64_t boot = 0;
  return digits.size() == 16 && read_whole_number(digits, boot, 16) ? boot : 0;
}

struct ProcessState {
  char letter;
  std::uint64_t start;
};

// Returns what /proc/<process>/stat has, or nothing where there is no such process, or it is
// hidden.
std::optional<ProcessState> state_of(const std::string& process) {
  std::ifstream file("/proc/" + process + "/stat");
  std::string text;
  std::getline(file, text);
  const auto name_end = text.rfind(')');  // the name itself may hold anything
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  ProcessState found{};
  fields >> found.letter;
  constexpr int kBetween = 18;  // fields 4 to 21 of proc(5); the start is the 22nd
  std::string skipped;
  for (int k = 0; k < kBetween; ++k) fields >> skipped;
  if (!(fields >> found.start)) return std::nullopt;
  return found;
}

// A container may see the /proc of another PID namespace, with other numbers.
bool proc_has_our_numbers() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self", error) == fmt::to_string(getpid());
}

// Says whether a process of this PID namespace still runs.  A zombie has a number and runs no more.
// Where nothing reaps it, as in some containers, it stays one.
bool is_running(pid_t process, std::uint64_t start) {
  if (proc_has_our_numbers())
    if (const auto found = state_of(fmt::to_string(process)))
      return found->start == start && found->letter != 'Z';
  return kill(process, 0) == 0 || errno != ESRCH;
}

enum class Lock { kFree, kHeld, kUnknown };

Lock lock_on(int descriptor) {
  // A shared lock needs no right to write.  It is let go with the descriptor.
  if (flock(descriptor, LOCK_SH | LOCK_NB) == 0) return Lock::kFree;
  return errno == EWOULDBLOCK ? Lock::kHeld : Lock::kUnknown;
}

}  // namespace

WriterId this_writer() {
  WriterId id;
  id.process = getpid();
  struct stat status {};
  const auto self = state_of("self");
  if (self && stat("/proc/self/ns/pid", &status) == 0) {
    id.boot = boot_of_this_machine();
    id.process_namespace = status.st_ino;
    id.start = self->start;
  } else {
    id.start = std::random_device{}();
  }
  return id;
}

std::string text_of(const WriterId& id) {
  return fmt::format("domefall-{:016x}-{:x}-{:x}-{}-{}", id.boot, id.device, id.process_namespace,
                     id.process, id.start);
}

std::optional<WriterId> writer_of(std::string_view text) {
  std::array<std::string_view, 6> fields;
  std::string_view rest = text;
  for (std::string_view& field : fields) {
    field = rest.substr(0, rest.find('-'));
    rest.remove_prefix(std::min(rest.size(), field.size() + 1));
  }
  constexpr int kHexadecimal = 16, kDecimal = 10;
  WriterId id;
  if (!read_whole_number(fields[1], id.boot, kHexadecimal) ||
      !read_whole_number(fields[2], id.device, kHexadecimal) ||
      !read_whole_number(fields[3], id.process_namespace, kHexadecimal) ||
      !read_whole_number(fields[4], id.process, kDecimal) ||
      !read_whole_number(fields[5], id.start, kDecimal) || text_of(id) != text)
    return std::nullopt;
  return id;
}

std::uint64_t device_of(const std::filesystem::path& folder) {
  struct stat status {};
  return stat(folder.c_str(), &status) == 0 ? status.st_dev : 0;
}

bool has_ended(const WriterId& id, int descriptor, std::uint64_t device) {
  const Lock lock = lock_on(descriptor);
  if (lock == Lock::kHeld) return false;
  const WriterId here = this_writer();
  if (id.boot == here.boot && here.boot != 0) {
    if (id.process_namespace == here.process_namespace) return !is_running(id.process, id.start);
    // Two mounts of what a file server has do not see each other's locks.
    if (lock == Lock::kFree && id.device != 0 && id.device == device) return true;
  }
  struct stat status {};
  return fstat(descriptor, &status) == 0 && std::time(nullptr) - status.st_mtime > kBeyondDoubt;
}

}  // namespace domefall
