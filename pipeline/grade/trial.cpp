#include "pipeline/grade/trial.h"

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
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

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

void confine(int to, pid_t program, const TrialBounds& bounds) {
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
                              const TrialBounds& bounds) {
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
pid_t copy_without_signals(int to, const std::function<void()>& step, const TrialBounds& bounds) {
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

// Reads whatever the copy writes until it ends, and says whether it ended in time.
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
                       const TrialBounds& bounds) {
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

void try_elsewhere(const std::string& name, const std::function<void()>& step,
                   const TrialBounds& bounds) {
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
