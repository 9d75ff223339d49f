// This is the program domefall, which makes graded Domemaster frames from a show file.
//
// Its exit codes are
//   0        it is done
//   2        the input is wrong, and trying again is useless
//   75       it is worth trying again, here or elsewhere
//   128 + n  signal n has stopped it
//   1        anything else

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <system_error>

#include "pipeline/base/errors.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/talk.h"
#include "pipeline/program/cli/command_line.h"
#include "pipeline/render/thread_limit.h"

namespace {

constexpr int kFailure = 1;

int report(const char* message, int code) {
  domefall::say(message);
  return code;
}

// Opens /dev/null in the place of each standard stream that the caller has closed.  Otherwise a
// file would get the stream's number, and whatever is said on that stream would go into the file.
void occupy_standard_streams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // An open takes the lowest free number.  Standard output is opened for reading, so that
    // printing still fails.
    if (fcntl(number, F_GETFD) < 0)
      (void)!open("/dev/null", number == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

bool reader_has_gone() {
  pollfd out{STDOUT_FILENO, 0, 0};
  return poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

int output_failure(int error) {
  // `domefall states SHOW | head` ends like any program that is told of it by the signal.
  if (reader_has_gone()) return 128 + SIGPIPE;
  const std::string why = error ? std::strerror(error) : "not all could be written";
  return report(("standard output: " + why).c_str(), domefall::kTryAgain);
}

// Flushes standard output, and returns the code if all of it has been written.  Other programs may
// read it, so that anything less is a failure.
int flushed(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  return output_failure(errno);
}

}  // namespace

int main(int argc, char** argv) {
  domefall::install_terminate_handler();
  try {
    occupy_standard_streams();
    // By default these signals end the program where it stands, when a reader has gone or a file
    // exceeds its size limit.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    domefall::leave_nothing_when_stopped();
    return flushed(domefall::run_command_line(argc, argv));
  } catch (const domefall::Interrupted& stop) {
    if (stop.expected) return domefall::code_after(stop.signal);
    return report("stopped; run the same command again to go on",
                  domefall::code_after(stop.signal));
  } catch (const domefall::InputError& error) {
    return report(error.what(), domefall::kBadInput);
  } catch (const domefall::TemporaryError& error) {
    return report(error.what(), domefall::kTryAgain);
  } catch (const std::system_error& error) {
    // What is printed in the middle of a verb fails where it is printed.
    if (std::ferror(stdout)) return output_failure(error.code().value());
    // Such errors are due to the machine and the moment, as when threads cannot be started or a
    // folder is gone.
    if (error.code() != std::errc::resource_unavailable_try_again)
      return report(error.what(), domefall::kTryAgain);
    return report("no more threads can be started: raise the limit, or take fewer --threads",
                  domefall::kTryAgain);
  } catch (const std::bad_alloc&) {
    return report("out of memory: fewer --threads or a smaller --size may fit",
                  domefall::kTryAgain);
  } catch (const std::exception& error) {
    return report(error.what(), kFailure);
  }
}
