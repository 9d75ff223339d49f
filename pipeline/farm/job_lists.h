// These functions write a plan as other queue managers read it.  Those that write JSON throw
// InputError for a path that is not UTF-8.
#pragma once

#include <string>

#include "pipeline/farm/plan.h"

namespace domefall {

// Returns one command line a chunk, quoted for a shell.
std::string list_of_commands(const FarmPlan& plan);

// Returns an Open Job Description template, version 2023-09, without extensions.  It has a step
// with one task a chunk.  After it follow a step that verifies and repairs, and those for the movie
// and the delivery that the plan asks for.  Throws InputError for a path that holds {{.  There are
// at most kMostOpenJdTasks chunks.
// https://github.com/OpenJobDescription/openjd-specifications/wiki/2023-09-Template-Schemas
std::string openjd_template(const FarmPlan& plan);
inline constexpr int kMostOpenJdTasks = 1024;

// Returns a job for Flamenco's job type farm/flamenco/domefall.js, as its manager takes it at
// /api/v3/jobs.
std::string flamenco_job(const FarmPlan& plan);

}  // namespace domefall
