#include "pipeline/base/child_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"

namespace domefall {
namespace {

struct Drained {
  std::string text;
  std::uint64_t bytes = 0;  // of all that came
};

// Reads a pipe to its end.  Keeps about `most` of its first bytes, or from `most` to 2 `most` of
// its last.
Drained drain(int from, std::size_t most, bool last) {
  const Descriptor closed(from);
  Drained drained;
  std::string& text = drained.text;
  std::array<char, 1 << 16> piece;
  for (ssize_t got = 0; (got = read(from, piece.data(), piece.size())) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    drained.bytes += static_cast<std::uint64_t>(got);
    if (last || text.size() < most) text.append(piece.data(), static_cast<std::size_t>(got));
    if (last && text.size() > 2 * most) text.erase(0, text.size() - most);
  }
  return drained;
}

std::string last_lines(std::string text) {
  constexpr std::size_t kLines = 6;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::size_t begin = text.size();
  for (std::size_t lines = 0; lines < kLines && begin != std::string::npos && begin > 0; ++lines)
    begin = text.rfind('\n', begin - 1);
  return begin == std::string::npos || begin == 0 ? text : text.substr(begin + 1);
}

// Returns the texts as a program takes them, with a null at the end.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

Pipe::Pipe(const std::string& program) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw TemporaryError(program + ": no pipe can be made: " + std::strerror(errno));
  from = ends[0], to = ends[1];
}

// posix_spawn() has no way to tie the program's life to this one.
pid_t start_program(std::vector<std::string> arguments, std::vector<std::string> environment,
                    const std::function<void(pid_t)>& prepare) {
  const std::vector<char*> words = pointers_to(arguments), settings = pointers_to(environment);
  char* const* const variables = environment.empty() ? environ : settings.data();
  const Pipe failed(arguments.front());
  // No signal reaches the child while it still has the handlers of this process.
  sigset_t all, before, none;
  sigfillset(&all);
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = getpid(), process = fork();
  if (process == 0) {
    prepare(parent);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    execvpe(words[0], words.data(), variables);
    const int error = errno;
    (void)!::write(failed.to, &error, sizeof error);
    _exit(kCannotStart);
  }
  int why = process < 0 ? errno : 0;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(failed.to);
  if (process > 0 && read(failed.from, &why, sizeof why) > 0) waitpid(process, nullptr, 0);
  close(failed.from);
  return why == 0 ? process : -why;
}

bool ChildOutcome::good() const { return WIFEXITED(status) && WEXITSTATUS(status) == 0; }

bool ChildOutcome::killed() const { return WIFSIGNALED(status); }

std::string ChildOutcome::text() const {
  const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const std::string how =
      number != 0 ? fmt::format("was ended by signal {} ({})", number, strsignal(number))  // NOLINT
                  : fmt::format("ended with code {}", WEXITSTATUS(status));
  return said.empty() ? how : how + ":\n" + said;
}

ChildProgram::ChildProgram(std::vector<std::string> arguments, const std::vector<int>& kept,
                           const std::string& package) {
  const std::string program = arguments.front();
  const Pipe in(program), out(program), error(program);
  process_ = start_program(std::move(arguments), {}, [&](pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kCannotStart);  // the parent died before prctl() was called
    setpgid(0, 0);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE})
      std::signal(number, SIG_DFL);
    dup2(in.from, STDIN_FILENO);
    dup2(out.to, STDOUT_FILENO);
    dup2(error.to, STDERR_FILENO);
    for (const int number : kept) fcntl(number, F_SETFD, 0);
  });
  for (const int end : {in.from, out.to, error.to}) close(end);
  if (process_ < 0) {
    for (const int end : {in.to, out.from, error.from}) close(end);
    if (process_ == -ENOENT)
      throw TemporaryError(fmt::format(
          "the program {} is not on the PATH; Debian's package {} has it", program, package));
    throw TemporaryError(program + ": cannot be started: " + std::strerror(-process_));
  }
  input_ = in.to;
  constexpr int kPipeBytes = 1 << 20;  // what every user may have
  fcntl(input_, F_SETPIPE_SZ, kPipeBytes);
  constexpr std::size_t kMostSaid = 1 << 14;
  said_ = std::async(std::launch::async,
                     [from = error.from] { return drain(from, kMostSaid, true).text; });
  read_ = std::async(std::launch::async, [this, from = out.from] {
    Drained drained = drain(from, kMostOutput, false);
    output_ = std::move(drained.text);
    output_bytes_ = drained.bytes;
  });
}

ChildProgram::~ChildProgram() {
  if (input_ >= 0) close(input_);
  if (process_ <= 0) return;
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

ChildOutcome ChildProgram::wait() {
  close(input_);
  input_ = -1;
  ChildOutcome outcome;
  while (waitpid(process_, &outcome.status, 0) < 0)
    if (errno != EINTR) throw TemporaryError("a program that was started has been lost");
  process_ = -1;
  read_.get();
  outcome.said = last_lines(said_.get());
  return outcome;
}

MemoryFile::MemoryFile(const std::string& purpose)
    : purpose_(purpose + " in memory"), descriptor_(memfd_create("domefall", MFD_CLOEXEC)) {
  if (number() < 0) throw_file_error(purpose_, errno);
}

void MemoryFile::append(std::string_view bytes) const {
  if (!write_all(number(), bytes)) throw_file_error(purpose_, errno);
}

std::string MemoryFile::contents() const {
  std::string all(FileBytes(number(), purpose_).size(), '\0');
  all.resize(read_at(number(), purpose_, 0, all.data(), all.size()));
  return all;
}

std::string MemoryFile::path() const { return fmt::format("/proc/self/fd/{}", number()); }

}  // namespace domefall
