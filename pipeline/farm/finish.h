// After the frames of a plan follow their verification, the next round, a movie and a delivery.
#pragma once

#include <string>
#include <vector>

#include "pipeline/farm/plan.h"

namespace domefall {

// FramesVerdict is what `domefall farm verify` says of a plan's frames.
struct FramesVerdict {
  bool complete = false;
  std::string to_make;  // frames that are missing, damaged or stale: 3-5,9
  int to_make_count = 0, frames = 0;
};

// Runs `domefall farm verify`, which reads all frames.  Throws InputError and TemporaryError as it
// does.
FramesVerdict verify_frames(const FarmPlan& plan);

// Returns the plan with a further round, of those frames.  Their chunks are as long as those of
// round 0 are on average, and at most `most`.
FarmPlan with_round(FarmPlan plan, const FramesVerdict& verdict, int most);

// Returns the command lines that make what the plan asks for of its frames.
std::vector<std::string> movie_command(const FarmPlan& plan);
std::vector<std::string> deliver_command(const FarmPlan& plan);

// Runs those that the plan asks for, one after another.  Throws InputError or TemporaryError where
// one fails with 2 or 75, and std::runtime_error for another code.
void make_movie_and_delivery(const FarmPlan& plan);

}  // namespace domefall
