// A plan goes through rounds.  Its chunks are rendered, all frames verified, and what is missing or
// bad is rendered again, until all is good or as often as the plan allows.
#pragma once

#include <string>

#include "pipeline/farm/plan.h"
#include "pipeline/image/errors.h"

namespace domefall {

// FramesLacking says that frames are still missing or bad after the last round, or after one that
// was cancelled.
struct FramesLacking : TemporaryError {
  using TemporaryError::TemporaryError;
};

// Goes through all rounds on this machine, or on Slurm while this process waits, and then makes
// what else the plan asks for.  Returns the signal that ended it early, or 0.  Throws InputError
// where the show is refused here, FramesLacking where frames are still missing or bad, and
// std::runtime_error where a defect is the reason.
int run_rounds(FarmPlan plan);

// Submits a round to Slurm with the job that concludes it, and notes it in the plan.  Returns the
// id of the array, or of that job where there is nothing to render.  Cancels the array where the
// other one is refused.
std::string submit_round(FarmPlan plan, int round);

// Does what that job does.  It verifies, then submits the next round, or makes what else the plan
// asks for.  This may be called again for the same round, as Slurm may run a job twice.  Throws as
// run_rounds().
void conclude_round(const FarmPlan& plan, int round);

}  // namespace domefall
