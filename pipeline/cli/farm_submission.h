// This file makes the plan of `domefall farm submit`, which says what frames are to be made and
// which chunks of them take equal time.
#pragma once

#include <string>
#include <vector>

#include "pipeline/cli/farm_products.h"
#include "pipeline/farm/plan.h"

namespace domefall {

struct SubmitOptions {
  std::string show, engine, frames, size, out, program, overlays;
  FarmProducts products;
  std::vector<std::string> engine_options;
  int workers = 0, threads = 0, chunk = 0, at_once = 0, retries = 3, rounds = 2;
  bool replace = false, wait = false, dry = false;
};

// Reads the show, renders a few small frames of it, and looks at what is in the folder.  Throws
// InputError for whatever a task would refuse, before anything is made.
FarmPlan make_plan(const SubmitOptions& options);

}  // namespace domefall
