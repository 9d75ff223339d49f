#include "farm/signal_inbox.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

std::array<int, 2> inbox{-1, -1};  // a pipe, through which the handler wakes wait()

void put_into_inbox(int signal) {
  const int error = errno;
  const auto number = static_cast<unsigned char>(signal);
  (void)!write(inbox[1], &number, 1);
  errno = error;
}

}  // namespace

SignalInbox::SignalInbox() {
  if (pipe2(inbox.data(), O_CLOEXEC | O_NONBLOCK) != 0)
    throw TemporaryError("no pipe can be opened for signals");
  struct sigaction action {};
  action.sa_handler = put_into_inbox;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGCHLD}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN && signal != SIGCHLD) continue;
    sigaction(signal, &action, &before_[signal]);
  }
}

SignalInbox::~SignalInbox() {
  for (const auto& [signal, action] : before_) sigaction(signal, &action, nullptr);
  for (int& end : inbox) close(end), end = -1;
}

std::vector<int> SignalInbox::take() {
  std::vector<int> signals;
  std::array<unsigned char, 256> numbers{};
  for (ssize_t got = 0; (got = read(inbox[0], numbers.data(), numbers.size())) > 0;)
    for (ssize_t k = 0; k < got; ++k)
      if (const int signal = numbers[static_cast<std::size_t>(k)]; signal != SIGCHLD)
        signals.push_back(signal);
  return signals;
}

void SignalInbox::wait(double seconds, const std::vector<int>& descriptors) const {
  std::vector<pollfd> polled{{inbox[0], POLLIN, 0}};
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  poll(polled.data(), polled.size(), static_cast<int>(1000 * seconds));
}

}  // namespace domefall
