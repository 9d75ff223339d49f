// Ends a run in an orderly way where the system grants too few threads, by ulimit -u or the
// pids.max of a cgroup.
#pragma once

namespace domefall {

// The exit code (EX_TEMPFAIL of sysexits.h) of a run that is worth trying again, here or elsewhere.
inline constexpr int kTryAgain = 75;

// Throws TemporaryError unless the system grants all threads of a program that makes frames with
// `threads` threads of its own.  It asks once, before the first of them is started, because the
// libraries end the program, or wait for ever, where they cannot start a thread.
void require_threads(int threads);

// Returns the number of threads that --threads asks for, where 0 stands for one per processor.
int all_threads(int given);

// From now on, where a library ends the program because a thread cannot be started after all, the
// program says so and exits with kTryAgain.  Any other such end stays as it is.
void install_terminate_handler();

}  // namespace domefall
