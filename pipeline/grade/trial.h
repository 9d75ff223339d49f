// A trial does first in another process what may end this one.
#pragma once

#include <functional>
#include <string>

namespace domefall {

// TrialBounds say what a trial may take: processor time, time by the clock, and memory beyond that
// of this process.
struct TrialBounds {
  int cpu_seconds = 5, seconds = 60, gibibytes = 4;
};

// Calls `step` in a copy of this process, which has these bounds, writes nothing to the terminal,
// and is gone when this function returns.  What `step` changes is changed in the copy alone.  The
// copy has one thread, no handlers of signals and no files of this process.  `step` may need no
// lock that another thread of this process may hold.
//
// Throws InputError or TemporaryError as `step` does.  Throws InputError, which begins with `name`,
// if the copy crashes or takes more processor time or memory than these bounds, and TemporaryError
// if the copy cannot be made or has not ended in time, since it may wait for a slow disk.
void try_elsewhere(const std::string& name, const std::function<void()>& step,
                   const TrialBounds& bounds = {});

}  // namespace domefall
