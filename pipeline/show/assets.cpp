#include "pipeline/show/assets.h"

#include <cstdlib>
#include <system_error>

namespace domefall {
namespace fs = std::filesystem;
namespace {

// getenv is safe among threads, since nothing in Domefall changes its environment.
fs::path named_folder() {
  const char* named = std::getenv("DOMEFALL_ASSETS");  // NOLINT(concurrency-mt-unsafe)
  return named ? named : "";
}

// Returns the folder that take_program_folder() has set, which is empty before.
fs::path& given_program_folder() {
  static fs::path folder;
  return folder;
}

// Returns the folder of the running program, or an empty path where the system does not tell it.
// Linux keeps a link to the running program at /proc/self/exe.
fs::path program_folder() {
  if (!given_program_folder().empty()) return given_program_folder();
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

}  // namespace

void take_program_folder(const fs::path& folder) { given_program_folder() = folder; }

fs::path assets_folder() {
  if (fs::path named = named_folder(); !named.empty()) return named;
  std::error_code error;
  if (const fs::path program = program_folder(); !program.empty()) {
    fs::path installed = program.parent_path() / "share" / "domefall" / "assets";
    if (fs::is_directory(installed, error)) return installed;
  }
  // A program that was built but not installed takes the assets of the source tree.
  return DOMEFALL_SOURCE_ASSETS;
}

fs::path shipped_asset(std::string_view name) {
  std::error_code error;
  fs::path file = assets_folder() / name;
  // A folder that the user names stands alone, so that what it lacks is reported as missing there.
  if (!named_folder().empty() || fs::exists(file, error)) return file;
  for (const fs::path& folder : {program_folder() / "assets", fs::path(DOMEFALL_BUILT_ASSETS)})
    if (fs::path built = folder / name; fs::exists(built, error)) return built;
  return file;
}

}  // namespace domefall
