// A LensRun writes the lens maps of a show's frames.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/show/show.h"

namespace domefall {

struct LensRun {
  const Show& show;
  std::vector<int> frames;
  std::filesystem::path folder;  // gets lens/NAME_00000.exr
  int threads = 0;               // 0 stands for one per processor
  bool replace = false;          // good maps of another size or show, too
  bool dry = false;              // only prints the frames whose maps it would make
};

// Makes what is missing, damaged or of another version of the show, and leaves alone what is good.
// No sky and no catalogue is read.  Throws InputError, TemporaryError or Interrupted.  Maps
// finished before stay.
void run_lens_maps(const LensRun& run);

}  // namespace domefall
