// The local engine runs the tasks of a plan on this machine, each as a process `domefall farm
// work`, which is what a cluster runs, too.
#pragma once

#include <optional>

#include "pipeline/farm/plan.h"

namespace domefall {

class SignalInbox;

struct LocalOutcome {
  int signal = 0;        // that ended the run early, or 0
  bool away = false;     // the show or the folder went away and stayed away
  bool refused = false;  // a task's input was refused, and so is the show here
  bool failed = false;   // a defect
  int given_up = 0;      // chunks
};

// Runs the chunks of a round, at most plan.at_once at the same time, each with its share of
// plan.threads.  A task that exits with 75, or is killed, is tried again, plan.retries times, after
// pauses that grow.  While the show or the folder is away no task is begun.  The first signal lets
// the workers finish their frames, and a second one ends them at once.
LocalOutcome run_locally(const FarmPlan& plan, int round, SignalInbox& inbox);

}  // namespace domefall
