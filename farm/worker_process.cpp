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
#include <cstring>

#include "pipeline/base/child_program.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"

namespace domefall {
namespace {

constexpr std::size_t kMostSaidBytes = 1 << 16;

}  // namespace

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name ? std::string("SIG") + name : fmt::format("signal {}", signal);
}

std::string WorkerEnd::text() const {
  return signal != 0 ? "killed by " + signal_name(signal) : fmt::format("exit code {}", code);
}

WorkerProcess::WorkerProcess(const std::vector<std::string>& arguments, const Way& way)
    : log_(way.log) {
  const Pipe talk(arguments.front());
  process_ = start_program(arguments, way.environment, [&](pid_t parent) {
    if (way.ends_with_us) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(kCannotStart);  // it has died before it was asked for
    }
    if (way.own_session) setsid();
    for (const int number : {SIGINT, SIGHUP, SIGUSR1, SIGCHLD, SIGPIPE, SIGXFSZ})
      std::signal(number, SIG_DFL);
    std::signal(SIGTERM, way.ignores_term ? SIG_IGN : SIG_DFL);
    const int input = open("/dev/null", O_RDONLY);
    dup2(input, STDIN_FILENO);
    if (input != STDIN_FILENO) close(input);
    dup2(talk.to, STDOUT_FILENO);
    dup2(talk.to, STDERR_FILENO);
  });
  close(talk.to);
  talk_ = talk.from;
  fcntl(talk_, F_SETFL, O_NONBLOCK);
  if (process_ > 0) return;
  close(talk_);
  throw TemporaryError(arguments.front() + ": cannot be started: " + std::strerror(-process_));
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
