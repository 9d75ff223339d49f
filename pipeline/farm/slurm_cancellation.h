// This file says whether somebody has cancelled a job of Slurm, which means that the rest is not
// wanted.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// A SlurmEnding is how a task of an array ended.
struct SlurmEnding {
  std::string state;  // Slurm's word, such as COMPLETED, or CANCELLED by 1000
  std::string time;   // 2026-01-31T23:59:59, of the cluster's clock
};

// Says whether the array's end was a cancellation.  Then no task that was not cancelled ended later
// than the last of those that were.  A task that was cancelled while others went on is no such end.
bool end_by_cancellation(const std::vector<SlurmEnding>& endings);

// Says the same of a job that has ended, as the controller remembers it, or else the accounting.
// Returns false where neither knows.
bool slurm_job_was_cancelled(const std::string& job);

}  // namespace domefall
