// The task runner renders one chunk of a plan, by a `domefall render` of its own.  All engines that
// run tasks themselves, here or on a cluster, run this.
#pragma once

#include <string>

#include "pipeline/farm/plan.h"

namespace domefall {

class SignalInbox;

// A TaskEnd says what came of a chunk.
struct TaskEnd {
  enum class Kind {
    kDone,
    kFailed,   // a defect, such as a pixel that is no number; another try fails, too
    kRefused,  // the input was refused three times in a row; it was good where it was submitted
    kAgain,    // worth another try anywhere: the worker was killed, or time is up
    kAgainElsewhere,  // worth another try, and better on another machine
    kStopped          // by a signal, which asked for no other try
  };
  Kind kind = Kind::kDone;
  std::string why;  // one line
  int signal = 0;   // of kStopped
};

struct TaskPlace {
  int threads = 1;
  // This says whether a manager signals the worker itself.  Then no signal but USR1 is passed on,
  // since a second TERM would end the worker in the middle of its frame.
  bool signals_reach_worker = false;
};

// Renders the chunk and says on standard error what the worker says.  USR1 asks it to end its frame
// and to be tried again.  INT, TERM and HUP end it.  A worker that something else stops is
// continued, and killed when it is stopped again.
TaskEnd run_task(const FarmPlan& plan, const PlannedChunk& chunk, const TaskPlace& place,
                 SignalInbox& inbox);

// Returns the command line by which any machine renders a chunk.
std::vector<std::string> render_command(const FarmPlan& plan, const std::string& frames,
                                        int threads);

// Returns the show or the folder of the frames, where it cannot be used at the moment, and
// otherwise an empty text.
std::string missing_path(const FarmPlan& plan);

}  // namespace domefall
