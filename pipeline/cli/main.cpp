// The program domefall, which makes graded Domemaster frames from a show file.
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

#include "pipeline/cli/command_line.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/image/errors.h"
#include "pipeline/render/thread_limit.h"

namespace {

constexpr int kFailure = 1;

int report(const char* message, int code) {
  std::fprintf(stderr, "%s\n", message);
  return code;
}

// A file must not get the number of a standard stream that the caller has closed: what is said
// there would go into the file.
void occupy_standard_streams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // An open takes the lowest free number.  What is printed on the second still fails.
    if (fcntl(number, F_GETFD) < 0)
      (void)!open("/dev/null", number == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

bool reader_has_gone() {
  pollfd out{STDOUT_FILENO, 0, 0};
  return poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

// Returns the code if all output has been written, since other programs may read it.
int flushed(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  // `domefall states SHOW | head` ends as any program does that is told by the signal.
  if (reader_has_gone()) return 128 + SIGPIPE;
  throw domefall::TemporaryError(std::string("standard output: ") +
                                 (errno ? std::strerror(errno) : "not all could be written"));
}

}  // namespace

int main(int argc, char** argv) {
  domefall::end_in_words_without_threads();
  try {
    occupy_standard_streams();
    // They would end the program where it stands: a reader who has gone, a limit on a file's size.
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
    // Of the machine and the moment: threads that may not be started, a folder that is gone.
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
