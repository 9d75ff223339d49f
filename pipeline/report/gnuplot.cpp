#include "pipeline/report/gnuplot.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <utility>

#include "pipeline/image/errors.h"
#include "pipeline/image/memory_file.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): only some libraries declare it

namespace domefall {
namespace {

struct Outcome {
  bool good;
  std::string out, said;  // standard output and standard error
};

// Runs gnuplot with its three standard streams on files in memory.  Files in a temporary folder
// would be in the way if the folder had to be removed while gnuplot still writes there.
Outcome gnuplot(std::string option, const std::string& script) {
  const MemoryFile in("the script for gnuplot"), out("gnuplot's drawing"), said("gnuplot's words");
  in.append(script);
  in.rewind();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.number(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, said.number(), STDERR_FILENO);
  std::string program = "gnuplot";
  char* const arguments[] = {program.data(), option.data(), nullptr};  // NOLINT(*-avoid-c-arrays)
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  // Where the system forks to start a program, it notices a missing one only in the child, which
  // then ends with 127.  Elsewhere posix_spawnp itself says ENOENT.
  constexpr const char* kMissing =
      "gnuplot is needed to draw the plots of a report; Debian's package is gnuplot-nox";
  if (error == ENOENT) throw InputError(kMissing);
  if (error != 0) throw TemporaryError("gnuplot could not be started");
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error("gnuplot was lost");
  constexpr int kNotFound = 127;  // the child's status if it finds no program
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) throw InputError(kMissing);
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, out.contents(), said.contents()};
}

}  // namespace

std::string gnuplot_version() {
  const Outcome outcome = gnuplot("--version", "");
  if (!outcome.good) throw InputError("gnuplot does not work: " + outcome.said);
  return outcome.out.substr(0, outcome.out.find('\n'));
}

std::string run_gnuplot(const std::string& script) {
  Outcome outcome = gnuplot("-", script);
  if (!outcome.good || outcome.out.empty()) throw std::runtime_error("gnuplot: " + outcome.said);
  return std::move(outcome.out);
}

}  // namespace domefall
