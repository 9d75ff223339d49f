#include "pipeline/grade/config_check.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {

namespace ocio = OCIO_NAMESPACE;

namespace {

void check_file(const ocio::Config& config, const char* named, const std::string& name) {
  std::string found;
  try {
    found = config.getCurrentContext()->resolveFileLocation(named);
  } catch (const ocio::Exception&) {
    return;  // A missing file matters only to those who use it, whom OpenColorIO tells.
  }
  try {
    if (RegularFile(found).size() > 0) return;
  } catch (const InputError& error) {
    throw InputError(name + ": names " + error.what());
  }
  throw InputError(name + ": names " + found + ": the file is empty");
}

// A group holds further transforms, which may be groups.  Any other transform stands alone.
void check_transform(const ocio::Config& config, const ocio::ConstTransformRcPtr& transform,
                     const std::string& name) {
  if (!transform) return;
  if (const auto group = std::dynamic_pointer_cast<const ocio::GroupTransform>(transform))
    for (int k = 0; k < group->getNumTransforms(); ++k)
      check_transform(config, group->getTransform(k), name);
  if (const auto file = std::dynamic_pointer_cast<const ocio::FileTransform>(transform))
    check_file(config, file->getSrc(), name);
}

constexpr float kLargestHalf = 65504, kBright = 1024;

// The pixels are RGB, greys of all magnitudes, and colours between black, small and large values.
std::vector<float> probes() {
  std::vector<float> rgb{1, 1, 1};
  for (float v = kLargestHalf; v > 1e-7f; v /= 1.07f) rgb.insert(rgb.end(), 3, v);
  constexpr std::array kLevels{0.0f, 6e-8f, 1e-3f, 0.18f, 0.5f, 1.0f, 16.0f, kBright, kLargestHalf};
  for (const float r : kLevels)
    for (const float g : kLevels)
      for (const float b : kLevels) rgb.insert(rgb.end(), {r, g, b});
  return rgb;
}

// Says whether no value of the pixel at `at` is NaN and, unless the pixel was above kBright, none
// is infinite.
bool is_sound(const std::vector<float>& before, const std::vector<float>& after, std::size_t at) {
  bool bright = false, infinite = false;
  for (std::size_t c = at; c < at + 3; ++c) {
    if (std::isnan(after[c])) return false;
    bright |= before[c] > kBright;
    infinite |= std::isinf(after[c]);
  }
  return bright || !infinite;
}

// Says whether OpenColorIO will replace the variable in the text, as $NAME, ${NAME} or %NAME%.
bool refers_to(std::string_view text, const std::string& variable) {
  return text.find("$" + variable) != std::string_view::npos ||
         text.find("${" + variable + "}") != std::string_view::npos ||
         text.find("%" + variable + "%") != std::string_view::npos;
}

// This is the first byte of what the copy writes, and the rest is a message.
constexpr char kDone = 'd', kInput = 'i', kTemporary = 't', kMemory = 'm';

void limit(int resource, rlim_t bound) {
  rlimit value{};
  getrlimit(static_cast<__rlimit_resource>(resource), &value);
  value.rlim_cur = std::min(bound, value.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &value);
}

// Returns how much address space this process has taken, of which sanitizers reserve terabytes.
rlim_t address_space() {
  unsigned long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%lu", &pages) != 1)
      pages = 0;  // NOLINT: one number, of the kernel's own
    std::fclose(file);
  }
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

// The handlers of this process would speak to its threads, which the copy has not, or through its
// pipes to this process itself.
void forget_handlers() {
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU})
    std::signal(number, SIG_DFL);
  // A terminal interrupts both, and it is this process that decides what becomes of the run.
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);
}

void close_all_but(int kept) {
  const auto number = static_cast<unsigned>(kept);
  close_range(STDERR_FILENO + 1, number - 1, 0);
  close_range(number + 1, ~0U, 0);
}

void confine(int to, pid_t program, const ChildBounds& bounds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != program) _exit(0);  // it ended before that
  forget_handlers();
  close_all_but(to);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(bounds.cpu_seconds));
  limit(RLIMIT_AS, address_space() + (static_cast<rlim_t>(bounds.gibibytes) << 30));
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

std::string outcome_of(const std::function<void()>& step) {
  try {
    step();
    return {kDone};
  } catch (const TemporaryError& error) {
    return kTemporary + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return {kMemory};
  } catch (const std::exception& error) {
    return kInput + std::string(error.what());
  }
}

[[noreturn]] void be_the_copy(int to, pid_t program, const std::function<void()>& step,
                              const ChildBounds& bounds) {
  confine(to, program, bounds);
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  const std::string outcome = outcome_of(step);
  for (std::size_t done = 0; done < outcome.size();) {
    const ssize_t written = write(to, outcome.data() + done, outcome.size() - done);
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  _exit(0);
}

// No signal reaches the copy while it still has the handlers of this process.
pid_t copy_without_signals(int to, const std::function<void()>& step, const ChildBounds& bounds) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t program = getpid(), copy = fork();
  if (copy == 0) be_the_copy(to, program, step, bounds);
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return copy;
}

bool read_in_time(int from, std::string& text, int seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  std::array<char, 4096> piece;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ready{from, POLLIN, 0};
    const int found = left > 0 ? poll(&ready, 1, static_cast<int>(left)) : 0;
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    const ssize_t got = read(from, piece.data(), piece.size());
    if (got == 0) return true;
    if (got > 0) text.append(piece.data(), static_cast<std::size_t>(got));
  }
}

[[noreturn]] void fail(const std::string& name, const std::string& outcome, int status,
                       const ChildBounds& bounds) {
  if (outcome.starts_with(kInput)) throw InputError(outcome.substr(1));
  if (outcome.starts_with(kTemporary)) throw TemporaryError(outcome.substr(1));
  if (outcome.starts_with(kMemory))
    throw InputError(
        fmt::format("{}: to read it takes more than {} GiB of memory", name, bounds.gibibytes));
  const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (number == SIGXCPU)
    throw InputError(fmt::format("{}: to read it takes more than {} s of processor time", name,
                                 bounds.cpu_seconds));
  throw InputError(
      fmt::format("{}: to read it crashes the reader ({}); something in it may refer "
                  "to itself",
                  name, number ? strsignal(number) : "it ended"));  // NOLINT
}

}  // namespace

// From each variable the search follows what its value refers to, and visits each other variable at
// most once.
void check_variables(const ocio::Config& config, const std::string& name) {
  const auto context = config.getCurrentContext();
  const int count = context->getNumStringVars();
  for (int first = 0; first < count; ++first) {
    std::vector<bool> seen(static_cast<std::size_t>(count), false);
    for (std::vector<int> left{first}; !left.empty();) {
      const std::string value = context->getStringVarByIndex(left.back());
      left.pop_back();
      if (value.find_first_of("$%") == std::string::npos) continue;
      for (int other = 0; other < count; ++other) {
        const auto at = static_cast<std::size_t>(other);
        if (seen[at] || !refers_to(value, context->getStringVarNameByIndex(other))) continue;
        if (other == first)
          throw InputError(fmt::format("{}: the variable {} refers to itself", name,
                                       context->getStringVarNameByIndex(first)));
        seen[at] = true;
        left.push_back(other);
      }
    }
  }
}

void check_files(const ocio::Config& config, const std::string& name) {
  const auto check = [&](const ocio::ConstTransformRcPtr& transform) {
    check_transform(config, transform, name);
  };
  const int spaces =
      config.getNumColorSpaces(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL);
  for (int k = 0; k < spaces; ++k) {
    const auto space = config.getColorSpace(
        config.getColorSpaceNameByIndex(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL, k));
    check(space->getTransform(ocio::COLORSPACE_DIR_TO_REFERENCE));
    check(space->getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE));
  }
  for (int k = 0; k < config.getNumLooks(); ++k) {
    const auto look = config.getLook(config.getLookNameByIndex(k));
    check(look->getTransform());
    check(look->getInverseTransform());
  }
  for (int k = 0; k < config.getNumViewTransforms(); ++k) {
    const auto view = config.getViewTransform(config.getViewTransformNameByIndex(k));
    check(view->getTransform(ocio::VIEWTRANSFORM_DIR_TO_REFERENCE));
    check(view->getTransform(ocio::VIEWTRANSFORM_DIR_FROM_REFERENCE));
  }
  for (int k = 0; k < config.getNumNamedTransforms(ocio::NAMEDTRANSFORM_ALL); ++k) {
    const auto named =
        config.getNamedTransform(config.getNamedTransformNameByIndex(ocio::NAMEDTRANSFORM_ALL, k));
    check(named->getTransform(ocio::TRANSFORM_DIR_FORWARD));
    check(named->getTransform(ocio::TRANSFORM_DIR_INVERSE));
  }
}

void check_values(const ocio::Config& config, const ocio::Processor& processor,
                  const std::string& name) {
  const std::vector<float> first = probes();
  std::vector<float> values = first;
  const auto steps = processor.createGroupTransform();
  for (int k = 0; k < steps->getNumTransforms(); ++k) {
    const auto cpu = config.getProcessor(steps->getTransform(k))->getDefaultCPUProcessor();
    ocio::PackedImageDesc image(values.data(), static_cast<long>(values.size() / 3), 1, 3);
    cpu->apply(image);
    for (std::size_t at = 0; at < values.size(); at += 3)
      if (!is_sound(first, values, at))
        throw InputError(
            fmt::format("{}: step {} of {} of the view makes ({:g}, {:g}, {:g}) of the pixel "
                        "({:g}, {:g}, {:g})",
                        name, k + 1, steps->getNumTransforms(), values[at], values[at + 1],
                        values[at + 2], first[at], first[at + 1], first[at + 2]));
  }
}

void try_in_child(const std::string& name, const std::function<void()>& step,
                  const ChildBounds& bounds) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw TemporaryError(name + ": no pipe can be made: " + std::strerror(errno));
  const pid_t copy = copy_without_signals(ends[1], step, bounds);
  const int error = errno;
  close(ends[1]);
  if (copy < 0) {
    close(ends[0]);
    throw TemporaryError(name + ": no process can be made: " + std::strerror(error));
  }
  std::string outcome;
  const bool in_time = read_in_time(ends[0], outcome, bounds.seconds);
  close(ends[0]);
  if (!in_time) kill(copy, SIGKILL);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time)
    throw TemporaryError(fmt::format("{}: to read it takes more than {} s", name, bounds.seconds));
  if (outcome != std::string{kDone}) fail(name, outcome, status, bounds);
}

}  // namespace domefall
