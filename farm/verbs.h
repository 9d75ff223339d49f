// What the verbs of `domefall farm` do: submit, work and conclude, status, verify.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "farm/farm_frames.h"

namespace domefall {

// ---- submit: makes a plan of a show's frames and hands it to an engine ----

// FarmProducts are what is to be made of the frames.  The texts and files are as `domefall movie` and `domefall deliver` take them.  Empty ones are not
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

// ---- work: a job of a farm, or a process of the local engine, does one task of a plan ----

struct WorkOptions {
  std::string out, plan;  // folder, and ID of its plan
  int round = 0, task = 0, threads = 0;
  bool slurm = false;  // this is a job that a submission of ours has made
};

// Renders the chunk of a task by a `domefall render` of its own, and says on standard error what the worker says.  USR1 asks it to end
// its frame and to be tried again.  INT, TERM and HUP end it.  A worker that something else stops is
// continued, and killed when it is stopped again.  Throws what leads to the exit code.  A job of
// Slurm whose task is worth another try puts itself back into the queue.
void work_on_task(const WorkOptions& options);

// Concludes a round (conclude_round).  In Slurm a folder that is away for a moment does not end the
// rounds, because this job goes back into the queue.
void conclude_job(const WorkOptions& options);

// ---- status, for people and for programs ----

// A FarmStatus is the state of a folder at one moment.
struct FarmStatus {
  FolderFindings found;
  Manifest manifest;
  std::vector<std::string> foreign;
  std::optional<double> frames_per_second;
  std::vector<SlowFrame> slowest;
  std::vector<FailedChunk> failed;
  std::string conclusion;  // FarmFrames::conclusion()
  double now_s = 0;        // since 1970
};

// Reads the beginnings of the files, and the manifests.  Throws as stop_if_interrupted().
FarmStatus farm_status(const FarmFrames& frames, int threads);

// Says whether every frame is made and can be read.
bool is_complete(const FarmStatus& status);

std::string farm_page(const FarmFrames& frames, const FarmStatus& status);
// Returns one JSON object, without a newline after it.
std::string farm_json(const FarmFrames& frames, const FarmStatus& status, int indent);

// ---- verify: reads every byte of a show's frames ----

// Prints what is found as a page or as JSON.  With `repair` it first has the frames made again that
// are not good, and looks at them again; it leaves alone what is no file, such as a folder of a
// frame's name.  Throws std::runtime_error where not all is there and good, TemporaryError where
// something cannot be read, and InputError if the folder to repair is another show's.  Also throws as
// FarmFrames and run_frames().
void verify_folder(const FarmRequest& request, bool json, bool repair);

}  // namespace domefall
