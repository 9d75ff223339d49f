// This file makes a job array of Slurm for the chunks of a round, and asks the controller what a
// task needs.
#pragma once

#include <string>
#include <vector>

#include "pipeline/farm/farm_task.h"
#include "pipeline/farm/plan.h"

namespace domefall {

// Returns how many tasks Slurm lets an array have (MaxArraySize).  Throws InputError where Slurm is
// not installed.  Throws TemporaryError where its controller does not answer within `patience_s`
// seconds or, if these are 0, within Slurm's own patience, which may be a minute.
int most_array_tasks(int patience_s = 0);
inline constexpr int kDefaultArrayTasks = 1001;

// These return command lines.  One submits the chunks of a round as an array.  The other submits
// the job which verifies their frames when all tasks have ended, however they ended, and goes on
// from there.  An array job may be requeued, and afterok would then cancel whoever waits for it.
// `after` is the array's id.  If it is empty, the job waits for nothing.
std::vector<std::string> array_submission(const FarmPlan& plan, int round);
std::vector<std::string> conclusion_submission(const FarmPlan& plan, int round,
                                               const std::string& after);

// Runs such a command line and returns the id of the job.  Throws TemporaryError where Slurm's
// controller does not answer, and InputError where it refuses the options, with what it said.
std::string submit_to_slurm(const std::vector<std::string>& command);

// Cancels all tasks of a job, as far as the controller answers.
void cancel_slurm_job(const std::string& job);

// Says whether none of a job's tasks waits or runs.  Returns false where the controller does not
// answer.
bool slurm_job_is_over(const std::string& job);

// A SlurmTask is the task of a job array in which this process runs, as SLURM_ARRAY_JOB_ID and
// others name it.
struct SlurmTask {
  std::string id;    // 12_3
  std::string node;  // SLURMD_NODENAME
  int restarts = 0;
  int processors = 1;
};
// Says whether this process runs in a Slurm job.
bool is_in_slurm();
SlurmTask this_slurm_task();

// Puts this task back into the queue, from where another node may take it.  With `elsewhere`, this
// node is left out of its next tries if the partition has another one.  A bad node is often idle,
// since its tasks end at once, and would be given them again and again.  Returns false where Slurm
// refuses.  Otherwise this waits up to two minutes for Slurm to end the task, and returns true.
bool requeue_slurm_task(const SlurmTask& task, bool elsewhere, SignalInbox& inbox);

}  // namespace domefall
