// The program domefall, which makes graded Domemaster frames from a show file.
//
// Its exit codes are
//   0        it is done
//   2        the input is wrong, and trying again is useless
//   75       it is worth trying again, here or elsewhere
//   128 + n  signal n has stopped it
//   1        anything else

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include "pipeline/cli/command_line.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/image/errors.h"

namespace {

constexpr int kTryAgain = 75, kFailure = 1;

int report(const char* message, int code) {
  std::fprintf(stderr, "%s\n", message);
  return code;
}

// Returns the code if all output has been written, since other programs may read it.
int flushed(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  throw domefall::TemporaryError(std::string("standard output: ") + std::strerror(errno));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return flushed(domefall::run_command_line(argc, argv));
  } catch (const domefall::Interrupted& stop) {
    return report("stopped; run the same command again to go on", 128 + stop.signal);
  } catch (const domefall::InputError& error) {
    return report(error.what(), domefall::kBadInput);
  } catch (const domefall::TemporaryError& error) {
    return report(error.what(), kTryAgain);
  } catch (const std::bad_alloc&) {
    return report("out of memory: fewer --threads or a smaller --size may fit", kTryAgain);
  } catch (const std::exception& error) {
    return report(error.what(), kFailure);
  }
}
