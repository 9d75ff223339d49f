// This file makes a job array of Slurm for the chunks of a round, and asks the controller what a
// task needs.
#pragma once

#include <string>
#include <vector>

#include "farm/engine.h"
#include "farm/plan.h"

namespace domefall {

// Returns how many tasks Slurm lets an array have (MaxArraySize).  Throws InputError where Slurm is
// not installed.  Throws TemporaryError where its controller does not answer within Slurm's own
// patience, which may be a minute.  For a plan that is only printed it waits three seconds, and then
// takes Slurm's default.
int most_array_tasks(bool only_printed);

// These return command lines.  One submits the chunks of a round as an array.  The other submits
// the job which verifies their frames when all tasks have ended, however they ended, and goes on
// from there.  An array job may be requeued, and afterok would then cancel whoever waits for it.
// `after` is the array's id.  If it is empty, the job waits for nothing.
std::vector<std::string> array_submission(const FarmPlan& plan, int round);
std::vector<std::string> conclusion_submission(const FarmPlan& plan, int round,
                                               const std::string& after);

// Returns both as lines for a shell.  The array's id is known only when it is submitted.
std::string slurm_commands(const FarmPlan& plan);

// Run them and return the id of the job.  Throw TemporaryError where Slurm's controller does not
// answer, and InputError where it refuses the options, with what it said.
std::string start_array(const FarmPlan& plan, int round);
std::string start_conclusion(const FarmPlan& plan, int round, const std::string& after);

// Waits until none of a job's tasks waits or runs, however long the controller may be away.
RoundOutcome wait_for_slurm(const FarmPlan& plan, int round, const std::string& job,
                            SignalInbox& inbox);

// Cancels all tasks of a job, as far as the controller answers.
void cancel_slurm_job(const std::string& job);

// A SlurmEnding is how a task of an array ended.
struct SlurmEnding {
  std::string state;  // Slurm's word, such as COMPLETED, or CANCELLED by 1000
  std::string time;   // 2026-01-31T23:59:59, of the cluster's clock
};

// Says whether the array's end was a cancellation.  Then no task that was not cancelled ended later
// than the last of those that were.  A task that was cancelled while others went on is no such end.
bool end_by_cancellation(const std::vector<SlurmEnding>& endings);

// Says so of a job that has ended, as the controller remembers it, or else the accounting.  Returns
// false where neither knows.
bool slurm_job_was_cancelled(const std::string& job);

// A SlurmTask is the task of a job array, or the job, in which this process runs, as
// SLURM_ARRAY_JOB_ID and others name it.
struct SlurmTask {
  std::string id;    // 12_3, or 13 of a job that is no array
  std::string node;  // SLURMD_NODENAME
  int restarts = 0;
  int processors = 1;
};
// Throws InputError where the environment names no job.  Nobody may call this but a process that a
// submission of ours has started, and that was told so.  A user's own job has the same variables.
SlurmTask this_slurm_task(bool of_array);

// Puts this task back into the queue, from where another node may take it.  With `elsewhere`, this
// node is left out of its next tries if the partition has another one.  A bad node is often idle,
// since its tasks end at once, and would be given them again and again.  Returns false where Slurm
// refuses.  Otherwise this waits up to two minutes for Slurm to end the task, and returns true.
bool requeue_slurm_task(const SlurmTask& task, bool elsewhere, SignalInbox& inbox);

}  // namespace domefall
