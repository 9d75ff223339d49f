#include "pipeline/show/assets.h"

#include <cstdlib>
#include <system_error>

namespace domefall {

std::filesystem::path assets_folder() {
  // getenv is safe among threads, since nothing in Domefall changes its environment.
  if (const char* named = std::getenv("DOMEFALL_ASSETS"); named && *named)  // NOLINT
    return named;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    const auto prefix = program.parent_path().parent_path();
    auto installed = prefix / "share" / "domefall" / "assets";
    if (std::filesystem::is_directory(installed, error)) return installed;
  }
  return DOMEFALL_SOURCE_ASSETS;
}

std::filesystem::path shipped_asset(std::string_view name) { return assets_folder() / name; }

}  // namespace domefall
