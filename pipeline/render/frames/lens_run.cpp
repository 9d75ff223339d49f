#include <fmt/format.h>

#include "pipeline/base/errors.h"
#include "pipeline/base/interruption.h"
#include "pipeline/base/talk.h"
#include "pipeline/image/frame_file.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/frames/frame_run.h"
#include "pipeline/render/frames/progress.h"
#include "pipeline/render/lens_map.h"
#include "pipeline/render/thread_limit.h"

namespace domefall {
namespace {

// Returns the frames whose maps are to be made.  Throws InputError if good ones of another size or
// show would be replaced unasked.
std::vector<int> maps_to_make(const FrameRun& run, const FrameFolder& folder) {
  std::vector<int> found;
  for (const int number : run.frames) {
    stop_if_interrupted();
    const WantedFrame wanted = folder.wanted(lens_map_key(run.show, frame_state(run.show, number)));
    const FrameCheck map = check_frame(folder.lens(number), wanted);
    if (map.condition == FrameCondition::kGood) continue;
    if (map.condition == FrameCondition::kOther && !run.replace)
      throw InputError(fmt::format(
          "{}: a good file, but another one than this run makes ({}). Another --out leaves it "
          "alone, --replace replaces it",
          folder.lens(number).string(), map.reason));
    found.push_back(number);
  }
  return found;
}

}  // namespace

void run_lens_maps(const FrameRun& run) {
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
  folder.prepare(frames, true);
  Progress progress(frames.size());
  for (const int number : frames) {
    stop_if_interrupted();
    const FrameState state = frame_state(run.show, number);
    const std::string key = lens_map_key(run.show, state);
    write_channels(folder.lens(number), make_lens_map(run.show, state, threads),
                   frame_info(run.show, key, state, dominant_view(state).observer, key));
    progress.made();
  }
  progress.end();
  say(fmt::format("{} lens maps made, {} already there, in {:.1f} s: {}", frames.size(),
                  run.frames.size() - frames.size(), progress.seconds(), run.folder.string()));
}

}  // namespace domefall
