#include "farm/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"

namespace domefall {
namespace {

constexpr int kCannotStart = 127;
constexpr std::size_t kMostSaidBytes = 1 << 16;

// Between fork() and exec() nothing may be called that could take a lock.
[[noreturn]] void become_worker(char* const* arguments, char* const* environment,
                                const WorkerProcess::Way& way, int talk, int failed, pid_t parent) {
  if (way.ends_with_us) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(kCannotStart);  // it has died before it was asked for
  }
  if (way.own_session) setsid();
  for (const int number : {SIGINT, SIGHUP, SIGUSR1, SIGCHLD, SIGPIPE, SIGXFSZ})
    std::signal(number, SIG_DFL);
  std::signal(SIGTERM, way.ignores_term ? SIG_IGN : SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  if (input != STDIN_FILENO) close(input);
  dup2(talk, STDOUT_FILENO);
  dup2(talk, STDERR_FILENO);
  execvpe(arguments[0], arguments, environment);
  const int error = errno;
  (void)!write(failed, &error, sizeof error);
  _exit(kCannotStart);
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

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name ? std::string("SIG") + name : fmt::format("signal {}", signal);
}

std::string WorkerEnd::text() const {
  return signal != 0 ? "killed by " + signal_name(signal) : fmt::format("exit code {}", code);
}

WorkerProcess::WorkerProcess(std::vector<std::string> arguments, const Way& way) : log_(way.log) {
  const std::vector<char*> words = pointers_to(arguments);
  std::vector<std::string> settings = way.environment;
  const std::vector<char*> given = pointers_to(settings);
  char* const* const variables = settings.empty() ? environ : given.data();
  std::array<int, 2> talk{}, failed{};
  const bool talks = pipe2(talk.data(), O_CLOEXEC) == 0;
  if (!talks || pipe2(failed.data(), O_CLOEXEC) != 0) {
    const std::string why = std::strerror(errno);
    if (talks) close(talk[0]), close(talk[1]);
    throw TemporaryError(arguments.front() + ": no pipe can be made: " + why);
  }
  // No signal reaches the child while it still has the handlers of this process.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become_worker(words.data(), variables, way, talk[1], failed[1], parent);
  int why = process_ < 0 ? errno : 0;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(talk[1]);
  close(failed[1]);
  if (process_ > 0 && read(failed[0], &why, sizeof why) > 0) waitpid(process_, nullptr, 0);
  close(failed[0]);
  talk_ = talk[0];
  fcntl(talk_, F_SETFL, O_NONBLOCK);
  if (why == 0) return;
  close(talk_);
  throw TemporaryError(arguments.front() + ": cannot be started: " + std::strerror(why));
}

WorkerProcess::~WorkerProcess() {
  if (process_ > 0) tell(SIGTERM);
  close(talk_);
}

void WorkerProcess::tell(int signal) const {
  if (process_ <= 0) return;
  kill(process_, signal);
  // A stopped process meets its signals only when it is continued.
  kill(process_, SIGCONT);
}

void WorkerProcess::copy() {
  std::array<char, 4096> piece{};
  for (ssize_t got = 0; (got = read(talk_, piece.data(), piece.size())) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    said_.append(piece.data(), static_cast<std::size_t>(got));
    if (said_.size() > 2 * kMostSaidBytes) said_.erase(0, said_.size() - kMostSaidBytes);
    // A log that cannot be written does not end the work.
    if (log_ >= 0) (void)!write(log_, piece.data(), static_cast<std::size_t>(got));
  }
}

std::optional<WorkerEnd> WorkerProcess::look() {
  copy();
  int status = 0;
  if (process_ <= 0 || waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
  process_ = -1;
  copy();
  if (WIFSIGNALED(status)) return WorkerEnd{0, WTERMSIG(status)};
  return WorkerEnd{WEXITSTATUS(status), 0};
}

void WorkerProcess::handle_stop(const std::string& name) {
  if (process_ <= 0) return;
  siginfo_t news{};
  if (waitid(P_PID, static_cast<id_t>(process_), &news, WSTOPPED | WNOHANG) != 0 ||
      news.si_pid == 0)
    return;
  const bool again = ++stops_ > 1;
  say(fmt::format("{}: process {} was stopped; {}", name, process_,
                  again ? "killed" : "continued"));
  kill(process_, again ? SIGKILL : SIGCONT);
}

std::string WorkerProcess::last_line() const {
  const std::size_t end = said_.find_last_not_of("\r\n");
  if (end == std::string::npos) return {};
  const std::size_t begin = said_.find_last_of("\r\n", end);
  return said_.substr(begin == std::string::npos ? 0 : begin + 1,
                      end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

WorkerEnd run_program(const std::vector<std::string>& arguments, std::string& said,
                      bool ignores_term, std::vector<std::string> environment) {
  try {
    WorkerProcess worker(arguments, {.log = -1,
                                     .own_session = false,
                                     .ends_with_us = !ignores_term,
                                     .ignores_term = ignores_term,
                                     .environment = std::move(environment)});
    for (;;) {
      if (const auto end = worker.look()) {
        said = worker.said();
        return *end;
      }
      pollfd talk{worker.talk(), POLLIN, 0};
      constexpr int kPollMs = 100;  // what it has started may keep the pipe open
      poll(&talk, 1, kPollMs);
      // Once the program has closed its end, poll() returns at once, and the loop would keep a
      // processor busy.
      if ((talk.revents & POLLHUP) != 0) usleep(1000);
    }
  } catch (const TemporaryError& error) {
    said = error.what();
    return {kCannotStart, 0};
  }
}

}  // namespace domefall
