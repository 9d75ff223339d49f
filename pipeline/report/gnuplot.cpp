#include "pipeline/report/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "pipeline/image/errors.h"
#include "pipeline/image/scratch_folder.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): only some libraries declare it

namespace domefall {
namespace {

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Outcome {
  bool good;
  std::string out, said;  // standard output and standard error
};

Outcome gnuplot(const ScratchFolder& folder, const std::string& argument) {
  const std::string out = (folder / "out").string(), said = (folder / "said").string();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC, kMode = 0600;
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), kWrite, kMode);
  posix_spawn_file_actions_addopen(&actions, 2, said.c_str(), kWrite, kMode);
  std::string program = "gnuplot", only = argument;
  char* const arguments[] = {program.data(), only.data(), nullptr};  // NOLINT(*-avoid-c-arrays)
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  constexpr const char* kMissing =
      "gnuplot is needed to draw the plots of a report; Debian's package is gnuplot-nox";
  if (error == ENOENT) throw InputError(kMissing);
  if (error != 0) throw TemporaryError("gnuplot could not be started");
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error("gnuplot was lost");
  constexpr int kNotFound = 127;  // the status where it is the child that finds no program
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) throw InputError(kMissing);
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, contents(out), contents(said)};
}

}  // namespace

std::string gnuplot_version() {
  const ScratchFolder folder;
  const Outcome outcome = gnuplot(folder, "--version");
  if (!outcome.good) throw InputError("gnuplot does not work: " + outcome.said);
  return outcome.out.substr(0, outcome.out.find('\n'));
}

std::string run_gnuplot(const std::string& script) {
  const ScratchFolder folder;
  const std::string file = (folder / "plot.gp").string();
  std::ofstream written(file);
  written << script;
  written.close();
  if (!written) throw TemporaryError(file + ": cannot be written");
  Outcome outcome = gnuplot(folder, file);
  if (!outcome.good || outcome.out.empty()) throw std::runtime_error("gnuplot: " + outcome.said);
  return std::move(outcome.out);
}

}  // namespace domefall
