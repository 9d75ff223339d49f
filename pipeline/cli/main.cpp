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

#include "pipeline/cli/interruption.h"
#include "pipeline/cli/verbs.h"
#include "pipeline/image/errors.h"
#include "pipeline/simd/dispatch.h"

namespace {

constexpr int kBadInput = 2, kTryAgain = 75, kFailure = 1;

int report(const char* message, int code) {
  std::fprintf(stderr, "%s\n", message);
  return code;
}

// Returns the code if all output has been written, since other programs may read it.
int flushed(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  throw domefall::TemporaryError(std::string("standard output: ") + std::strerror(errno));
}

int run(int argc, char** argv) {
  CLI::App app("Black-hole shows for planetariums: a show file in, graded Domemaster frames out");
  app.set_version_flag("--version", "domefall " DOMEFALL_VERSION);
  app.require_subcommand(1);
  domefall::add_check(app);
  domefall::add_render(app);
  domefall::add_grade(app);
  domefall::add_preview(app);
  domefall::add_states(app);
  domefall::add_probe(app);
  domefall::add_trace(app);
  domefall::add_report(app);
  domefall::add_stars(app);
  domefall::add_sky(app);
  // A wrong DOMEFALL_SIMD ends the program before anything is made.
  app.parse_complete_callback([] { domefall::simd_in_use(); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return flushed(run(argc, argv));
  } catch (const domefall::Interrupted& stop) {
    return report("stopped; run the same command again to go on", 128 + stop.signal);
  } catch (const domefall::InputError& error) {
    return report(error.what(), kBadInput);
  } catch (const domefall::TemporaryError& error) {
    return report(error.what(), kTryAgain);
  } catch (const std::bad_alloc&) {
    return report("out of memory: fewer --threads or a smaller --size may fit", kTryAgain);
  } catch (const std::exception& error) {
    return report(error.what(), kFailure);
  }
}
