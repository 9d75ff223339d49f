// Lets SIGINT and SIGTERM end a run between frames, so that nothing half-made stays behind.
#pragma once

namespace domefall {

struct Interrupted {
  int signal;
};

// Remembers the two signals from now on.  Without this call they end the program at once.
void catch_interruptions();

// Throws Interrupted if a signal has come.
void stop_if_interrupted();

}  // namespace domefall
