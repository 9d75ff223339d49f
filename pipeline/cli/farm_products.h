// FarmProducts are what `domefall farm submit` is asked to make of the frames, such as a movie and
// a folder for delivery.
#pragma once

#include <string>
#include <vector>

#include "pipeline/farm/plan.h"
#include "pipeline/show/show.h"

namespace domefall {

// The texts and files are as `domefall movie` and `domefall deliver` take them.  Empty ones are not
// asked for.
struct FarmProducts {
  std::string movie, deliver;          // a preset, a folder
  std::vector<std::string> audio;      // of the movie and of the delivery
  std::vector<std::string> subtitles;  // of the delivery, like what follows
  int depth = 0;
  bool leader = false;
};

// Puts the products into the plan for these frames of a show.  Throws InputError, before a frame is
// made, for whatever the two verbs would refuse however good the frames are, and for sound or parts
// of a delivery where nothing is asked for that has them.  Also throws as read_sound.
void add_products(FarmPlan& plan, const FarmProducts& products, const Show& show,
                  const std::vector<int>& frames);

}  // namespace domefall
