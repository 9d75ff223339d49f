// A job of a farm, or a process of the local engine, works on one task of a plan, by a `domefall
// render` of its own, or concludes a round.
#pragma once

#include <string>

namespace domefall {

struct WorkOptions {
  std::string out, plan;  // folder, and ID of its plan
  int round = 0, task = 0, threads = 0;
  bool slurm = false;  // this is a job that a submission of ours has made
};

// Renders the chunk of a task and says on standard error what the worker says.  USR1 asks it to end
// its frame and to be tried again.  INT, TERM and HUP end it.  A worker that something else stops is
// continued, and killed when it is stopped again.  Throws what leads to the exit code.  A job of
// Slurm whose task is worth another try puts itself back into the queue.
void work_on_task(const WorkOptions& options);

// Concludes a round (conclude_round).  In Slurm a folder that is away for a moment does not end the
// rounds, because this job goes back into the queue.
void conclude_job(const WorkOptions& options);

}  // namespace domefall
