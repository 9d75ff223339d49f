#include "pipeline/cli/interruption.h"

#include <csignal>

namespace domefall {
namespace {

volatile std::sig_atomic_t caught = 0;

// Remembers a signal.  A second one finds the default action and ends the program at once.
void remember(int signal) {
  caught = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interruptions() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

void stop_if_interrupted() {
  if (caught != 0) throw Interrupted{caught};
}

}  // namespace domefall
