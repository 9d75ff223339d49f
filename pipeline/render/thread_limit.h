// What becomes of a run where the system grants too few threads: ulimit -u, or a cgroup's pids.max.
#pragma once

namespace domefall {

// The exit code for what is worth trying again, here or elsewhere.
inline constexpr int kTryAgain = 75;

// Throws TemporaryError unless the system grants all threads of a program that makes frames with
// `threads` threads of its own.  It asks once, before the first of them is started: the libraries
// that start threads end the program, or wait for ever, where they cannot.
void require_threads(int threads);

// Where a library ends the program because a thread cannot be started all the same, it says so and
// exits with kTryAgain.  Any other such end stays as it is.
void end_in_words_without_threads();

}  // namespace domefall
