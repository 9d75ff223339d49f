#include "pipeline/cli/browser.h"

#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace domefall {

// Starts the desktop's own opener, and does not wait for it.  The opener ends when the browser has
// the address, and whatever it says is not for the terminal.
void open_browser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::string program = "xdg-open", address = url;
  std::array<char*, 3> arguments{program.data(), address.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", 02, 0);
  pid_t process = 0;
  posix_spawnp(&process, program.c_str(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
}

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "HOST";
  return name.data();
}

}  // namespace domefall
