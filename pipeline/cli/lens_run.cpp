#include "pipeline/cli/lens_run.h"

#include <fmt/format.h>

#include <cstdio>

#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/cli/interruption.h"
#include "pipeline/cli/progress.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/render/lens_map.h"
#include "pipeline/render/overlay/seen_better.h"
#include "pipeline/render/rays/steady.h"
#include "pipeline/render/thread_limit.h"

namespace domefall {
namespace {

FrameInfo info_of_map(const Show& show, const FrameState& state, const std::string& key) {
  const ObserverState& observer = seen_better(state).observer;
  FrameInfo info;
  info.title = show.title;
  info.key = info.show = key;
  info.frame = state.frame;
  info.region = region_name(observer.region);
  info.r = steady(observer.r);
  info.proper_time = steady(observer.proper_time);
  info.frames_per_second = show.frames_per_second;
  info.projection = projection_name(state.projection);
  info.software = kSoftware;
  info.owner = show.output.owner;
  return info;
}

// Returns the frames whose maps are to be made.  Throws InputError if good ones of another size or
// show would be replaced unasked.
std::vector<int> maps_to_make(const LensRun& run, const FrameFolder& folder) {
  std::vector<int> found;
  for (const int number : run.frames) {
    stop_if_interrupted();
    const WantedFrame wanted = folder.wanted(lens_map_key(run.show, frame_state(run.show, number)));
    const FrameCondition condition = examine_frame(folder.lens(number), wanted);
    if (condition == FrameCondition::kGood) continue;
    if (condition == FrameCondition::kOther && !run.replace)
      throw InputError(fmt::format(
          "{}: a good file, but another one than this run makes ({}). Another --out leaves it "
          "alone, --replace replaces it",
          folder.lens(number).string(), describe_difference(folder.lens(number), wanted)));
    found.push_back(number);
  }
  return found;
}

}  // namespace

void run_lens_maps(const LensRun& run) {
  catch_interruptions();
  const FrameFolder folder(run.folder, run.show);
  if (!run.replace) folder.check_owner();
  const std::vector<int> frames = maps_to_make(run, folder);
  if (run.dry) {
    if (!frames.empty()) fmt::print("{}\n", as_ranges(frames));
    return;
  }
  const int threads = all_threads(run.threads);
  require_threads(threads);
  set_file_threads(threads);
  folder.prepare_lens(frames);
  Progress progress(frames.size());
  for (const int number : frames) {
    stop_if_interrupted();
    const FrameState state = frame_state(run.show, number);
    write_channels(folder.lens(number), make_lens_map(run.show, state, threads),
                   info_of_map(run.show, state, lens_map_key(run.show, state)));
    progress.made();
  }
  std::fprintf(stderr, "%zu lens maps made, %zu already there, in %.1f s: %s\n", frames.size(),
               run.frames.size() - frames.size(), progress.seconds(), run.folder.c_str());
}

}  // namespace domefall
