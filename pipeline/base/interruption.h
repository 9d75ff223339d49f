// These functions let SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR1 end the program so that nothing
// half-made stays behind.  A signal that the program was started to ignore, by nohup or as a job in
// the background, stays ignored.
#pragma once

#include <optional>

namespace domefall {

struct Interrupted {
  int signal;
  bool expected = false;  // there is nothing to go on with, and nothing to say
};

// Returns the exit code after a signal.  It is 128 + its number, but 75 after SIGUSR1, by which
// queue managers tell that a time limit is near.
int code_after(int signal);

// From now on such a signal removes what is unfinished (temporary_file.h) and ends the program at once,
// with its code_after().  Throws TemporaryError where no thread can be started to do so, or no pipe
// can be opened to tell it.
void leave_nothing_when_stopped();

// From now on the first signal is only remembered, so that a run can end between frames.  A second
// one acts as above.
void catch_interruptions();

// Returns the signal that has been remembered, if there is one.
std::optional<int> was_interrupted();

// Throws Interrupted if a signal has been remembered.
void stop_if_interrupted();

}  // namespace domefall
