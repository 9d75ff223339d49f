// A submission makes a plan of a show's frames and hands it to an engine.
#pragma once

#include <string>
#include <vector>

namespace domefall {

// FarmProducts are what is to be made of the frames.
// The texts and files are as `domefall movie` and `domefall deliver` take them.  Empty ones are not
// asked for.
struct FarmProducts {
  std::string movie, deliver;          // a preset, a folder
  std::vector<std::string> audio;      // of the movie and of the delivery
  std::vector<std::string> subtitles;  // of the delivery, like what follows
  int depth = 0;
  bool leader = false;
};

struct SubmitOptions {
  std::string show, engine, frames, size, out, program, overlays;
  FarmProducts products;
  std::vector<std::string> engine_options;
  int workers = 0, threads = 0, chunk = 0, at_once = 0, retries = 3, rounds = 2;
  bool replace = false, wait = false, dry = false;
};

// Reads the show, renders a few small frames of it, looks at what is in the folder, and hands the
// plan to the engine, or only prints what that would be.  Throws InputError, before a frame is made,
// for whatever a task, `domefall movie` or `domefall deliver` would refuse however good the frames
// are, and for sound or parts of a delivery where nothing is asked for that has them.  Also throws as
// require_room(), run_rounds() and submit_round().
void submit(const SubmitOptions& options);

}  // namespace domefall
