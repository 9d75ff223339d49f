#include "pipeline/base/interruption.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <system_error>
#include <thread>

#include "pipeline/base/errors.h"
#include "pipeline/base/talk.h"
#include "pipeline/base/temporary_file.h"

namespace domefall {
namespace {

std::atomic<bool> first_is_remembered{false}, nothing_is_unfinished{false};
std::atomic<int> remembered{0};
std::array<int, 2> signal_pipe{-1, -1};  // a pipe, by which a handler tells a thread

constexpr int kSignalsCode = 128, kTryAgainCode = 75;

void on_signal(int signal) {
  if (nothing_is_unfinished) _exit(code_after(signal));
  int none = 0;
  if (first_is_remembered && remembered.compare_exchange_strong(none, signal)) return;
  const int error = errno;
  const auto number = static_cast<unsigned char>(signal);
  if (write(signal_pipe[1], &number, 1) != 1) _exit(code_after(signal));
  errno = error;
}

// Writes the line only if that can be done at once.  Nobody may be reading a pipe that is full, and
// a thread that waits for it holds the lock of the stream.
void say_to_terminal(std::string_view line) {
  pollfd out{STDERR_FILENO, POLLOUT, 0};
  if (poll(&out, 1, 0) > 0 && (out.revents & POLLOUT) != 0)
    (void)!write(STDERR_FILENO, line.data(), line.size());
}

// A thread waits for the signal's number and ends the program, because a handler is not allowed to
// remove folders.
void end_on_signal() {
  unsigned char signal = 0;
  while (read(signal_pipe[0], &signal, 1) != 1) {
  }
  remove_unfinished();
  nothing_is_unfinished = true;
  constexpr std::string_view kStopped = "\nstopped; what was not finished has been removed\n";
  say_to_terminal(bar_is_shown() ? kStopped : kStopped.substr(1));
  _exit(code_after(signal));
}

}  // namespace

void leave_nothing_when_stopped() {
  if (pipe2(signal_pipe.data(), O_CLOEXEC) != 0)
    throw TemporaryError("no pipe can be opened: " + std::generic_category().message(errno));
  try {
    std::thread(end_on_signal).detach();
  } catch (const std::system_error& error) {
    throw TemporaryError("no thread can be started: " + error.code().message());
  }
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

int code_after(int signal) { return signal == SIGUSR1 ? kTryAgainCode : kSignalsCode + signal; }

void catch_interruptions() { first_is_remembered = true; }

std::optional<int> was_interrupted() {
  const int signal = remembered;
  return signal != 0 ? std::optional(signal) : std::nullopt;
}

void stop_if_interrupted() {
  if (const auto signal = was_interrupted()) throw Interrupted{*signal};
}

}  // namespace domefall
