// A plan goes through rounds.  Its chunks are rendered, all frames verified, and what is missing or
// bad is rendered again, until all is good or as often as the plan allows.
#pragma once

#include <string>

#include "farm/plan.h"
#include "pipeline/base/errors.h"

namespace domefall {

// FramesLacking says that frames are still missing or bad after the last round, or after one that
// was cancelled.
struct FramesLacking : TemporaryError {
  using TemporaryError::TemporaryError;
};

// FramesVerdict is what `domefall farm verify` says of a plan's frames.
struct FramesVerdict {
  bool complete = false;
  std::string to_make;  // frames that are missing, damaged or stale: 3-5,9
  int to_make_count = 0, frames = 0;
};

// Returns the plan with a further round, of the frames that are to be made.  A chunk has as many
// frames as the plan's frames over the number of chunks of round 0, or more where there would be
// more than `most` chunks.
FarmPlan with_round(FarmPlan plan, const FramesVerdict& verdict, int most);

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
// asks for.  This may be called again for the same round, as Slurm may run a job twice.  `job` is
// its id, or empty where this process is no job.  Throws as run_rounds().
void conclude_round(const FarmPlan& plan, int round, const std::string& job);

}  // namespace domefall
