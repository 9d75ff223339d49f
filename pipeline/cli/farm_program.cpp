#include "pipeline/cli/farm_program.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "pipeline/farm/worker_process.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

fs::path this_program() {
  std::error_code error;
  fs::path self = fs::read_symlink("/proc/self/exe", error);
  if (error) throw TemporaryError("/proc/self/exe: " + error.message() + "; name --program");
  return self;
}

fs::path found_in_path(const std::string& name) {
  const char* const folders = std::getenv("PATH");
  std::istringstream stream(folders ? folders : "");
  for (std::string folder; std::getline(stream, folder, ':');) {
    fs::path file = fs::path(folder.empty() ? "." : folder) / name;
    if (access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file)) return file;
  }
  throw InputError("--program " + name + ": PATH has no such program; a path names one elsewhere");
}

void check_version(const fs::path& program) {
  std::string said;
  const WorkerEnd end = run_program({program.string(), "--version"}, said);
  const std::string line = said.substr(0, said.find('\n'));
  if (end.code != 0 || end.signal != 0)
    throw InputError("--program " + program.string() + ": does not run: " + end.text() +
                     (line.empty() ? "" : ", " + line));
  const std::string here = "domefall " DOMEFALL_VERSION;
  if (line != here)
    throw InputError("--program " + program.string() + ": is '" + line + "', and this is " + here +
                     "; frames are made by one version");
}

}  // namespace

std::string farm_program(const std::string& named, bool needed_here) {
  if (named.empty()) return this_program().string();
  const bool has_folder = named.find('/') != std::string::npos;
  const fs::path program =
      fs::absolute(has_folder ? fs::path(named) : found_in_path(named)).lexically_normal();
  std::error_code error;
  if (fs::exists(program, error) || needed_here)
    check_version(program);
  else
    std::fprintf(stderr, "warning: --program %s: is not here; it must be on the nodes\n",
                 program.c_str());
  return program.string();
}

}  // namespace domefall
