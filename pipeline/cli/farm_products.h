// What `domefall farm submit` is asked to make of the frames: a movie, a folder for delivery.
#pragma once

#include <string>
#include <vector>

#include "pipeline/farm/plan.h"
#include "pipeline/show/show.h"

namespace domefall {

// Texts and files as `domefall movie` and `domefall deliver` take them; empty for what is not asked
// for.
struct FarmProducts {
  std::string movie, deliver;          // a preset, a folder
  std::vector<std::string> audio;      // of the movie and of the delivery
  std::vector<std::string> subtitles;  // of the delivery, as is what follows
  int depth = 0;
  bool leader = false;
};

// Puts them into the plan of these frames of a show.  Throws InputError, before a frame is made,
// for whatever the two verbs would refuse however good the frames are, and where sound or a part of
// a delivery is asked for of nothing; and as read_sound.
void add_products(FarmPlan& plan, const FarmProducts& products, const Show& show,
                  const std::vector<int>& frames);

}  // namespace domefall
