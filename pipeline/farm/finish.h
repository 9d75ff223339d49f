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

// Returns the plan with a further round, of the frames that are to be made.  A chunk has as many
// frames as the plan's frames over the number of chunks of round 0, or more where there would be
// more than `most` chunks.
FarmPlan with_round(FarmPlan plan, const FramesVerdict& verdict, int most);

// Returns the command lines that make what the plan asks for of its frames.
std::vector<std::string> movie_command(const FarmPlan& plan);
std::vector<std::string> deliver_command(const FarmPlan& plan);

// Runs those that the plan asks for, one after another.  Throws InputError where one exits with 2,
// TemporaryError where one exits with 75, is killed or cannot be started, and std::runtime_error
// for another code.
void make_movie_and_delivery(const FarmPlan& plan);

}  // namespace domefall
