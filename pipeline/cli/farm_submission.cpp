#include "pipeline/cli/farm_submission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "pipeline/cli/farm_products.h"
#include "pipeline/cli/farm_program.h"
#include "pipeline/cli/frame_folder.h"
#include "pipeline/cli/frame_run.h"
#include "pipeline/cli/frame_survey.h"
#include "pipeline/cli/overlay_option.h"
#include "pipeline/farm/equal_chunks.h"
#include "pipeline/farm/job_lists.h"
#include "pipeline/farm/slurm.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frame_grading.h"
#include "pipeline/show/frame_size.h"
#include "pipeline/show/read_show.h"
#include "pipeline/survey/frame_costs.h"
#include "pipeline/survey/render_time.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr double kTaskSeconds = 300;  // of a task where there is much to do
// To share the work among many, a show is cut into tasks no shorter than this.  The start of a
// process takes 0.55 s with a grade, which is a hundredth of it.
constexpr double kShortTaskSeconds = 60;
constexpr int kFewestFrames = 10;   // a task of so many spends little of its time on being started
constexpr int kManyMachines = 100;  // a show is cut for so many where its tasks stay long enough
constexpr int kLongestLocalChunk = 100, kMostChunks = 10000, kTaskThreads = 4;

// Returns the seconds that each of these frames takes on a machine that does nothing else, with
// that many threads.  If they are not `measured`, each counts 1.  A few small frames are rendered
// in any case, which shows that what the show reads is there and can be read.
std::vector<double> frame_seconds(const Show& show, const std::vector<int>& frames, int threads,
                                  bool measured) {
  Renderer renderer(show);
  if (!measured) {
    relative_light_costs(show, {frames.front(), frames.back()}, renderer);
    return std::vector<double>(frames.size(), 1);
  }
  std::vector<double> costs = relative_light_costs(show, frames, renderer);
  std::optional<Grader> grader;
  if (show.output.graded) grader.emplace(show.grade);
  const RenderTime time = estimate_render_time(show, renderer, grader ? &*grader : nullptr);
  // Grading and writing take about as long for each frame, so only the time for its light varies.
  constexpr double kLeastPart = 1e-3;
  for (double& cost : costs)
    cost = time.processor_s / threads *
           std::max(kLeastPart, 1 - time.light_part + time.light_part * cost);
  return costs;
}

// Returns Slurm's limit, or its default where no controller answers, since a plan that is only
// printed needs none.
int most_array_tasks_if_known() {
  constexpr int kPatienceS = 3;
  try {
    return most_array_tasks(kPatienceS);
  } catch (const InputError&) {
  } catch (const TemporaryError&) {
  }
  std::fprintf(stderr,
               "Slurm does not answer here; an array is taken to have %d tasks at most, which is "
               "its default\n",
               kDefaultArrayTasks);
  return kDefaultArrayTasks;
}

int most_tasks(const SubmitOptions& o) {
  if (o.engine == "slurm") return o.dry ? most_array_tasks_if_known() : most_array_tasks();
  return o.engine == "openjd" ? kMostOpenJdTasks : kMostChunks;
}

int divided_up(int count, int by) { return (count + by - 1) / by; }

// Returns how many chunks to cut frames into that take `seconds` one after another on one machine.
// `seconds` is 0 where they have not been measured.
int chunk_count(const SubmitOptions& o, const FarmPlan& plan, int frames, double seconds) {
  const int most = most_tasks(o);
  if (o.chunk > 0) {
    const int count = divided_up(frames, o.chunk);
    if (count > most)
      throw InputError(fmt::format(
          "--chunk {}: {} frames would make more than the {} tasks that "
          "{}; --chunk {} or more fits",
          o.chunk, frames, most,
          o.engine == "slurm" ? "Slurm allows (MaxArraySize)" : "a job of this kind may have",
          divided_up(frames, most)));
    return count;
  }
  const bool local = o.engine == "local";
  const int by_time = static_cast<int>(std::min(1e6, std::ceil(seconds / kTaskSeconds)));
  const int by_frames = divided_up(frames, local ? kLongestLocalChunk : kFewestFrames);
  // There are so many chunks that the last ones do not keep others waiting, unless the chunks would
  // become too short.
  int many = local ? 4 * plan.at_once : std::min(kManyMachines, by_frames);
  if (seconds > 0) many = std::min(many, static_cast<int>(seconds / kShortTaskSeconds));
  if (local) many = std::max({many, plan.at_once, seconds > 0 ? 1 : by_frames});
  const int count = std::max(many, by_time);
  return std::clamp(count, 1, std::min(most, frames));
}

void add_chunks(FarmPlan& plan, const SubmitOptions& o, const Show& show,
                const std::vector<int>& frames) {
  if (frames.empty()) return;
  const int threads = o.engine == "local" ? std::max(1, plan.threads / plan.at_once) : plan.threads;
  const bool measured = o.chunk == 0 && is_worth_measuring(show);
  const std::vector<double> seconds = frame_seconds(show, frames, threads, measured);
  const double all = measured ? std::accumulate(seconds.begin(), seconds.end(), 0.0) : 0;
  const int count = chunk_count(o, plan, static_cast<int>(frames.size()), all);
  std::vector<std::vector<int>> chunks;
  if (o.chunk > 0)
    for (std::size_t k = 0; k < frames.size(); k += static_cast<std::size_t>(o.chunk))
      chunks.emplace_back(
          frames.begin() + static_cast<long>(k),
          frames.begin() +
              static_cast<long>(std::min(frames.size(), k + static_cast<std::size_t>(o.chunk))));
  else
    chunks = equal_chunks(frames, seconds, count);
  std::size_t next = 0;
  for (const std::vector<int>& chunk : chunks) {
    double estimate = 0;
    for (std::size_t k = 0; k < chunk.size(); ++k) estimate += seconds[next++];
    plan.chunks.push_back(
        {0, static_cast<int>(plan.chunks.size()), as_ranges(chunk), measured ? estimate : 0});
  }
}

}  // namespace

FarmPlan make_plan(const SubmitOptions& o) {
  Show show = read_show(o.show);
  overlay(show, o.overlays);
  show.projection = resized(show.projection, o.size);
  const std::vector<int> frames = parse_frames(o.frames, frame_count(show));
  FarmPlan plan;
  plan.id = o.dry ? "PLAN" : new_plan_id();
  plan.version = "domefall " DOMEFALL_VERSION;
  plan.program = farm_program(o.program, o.engine == "local");
  plan.show = fs::absolute(o.show).lexically_normal();
  plan.out = fs::absolute(frames_folder(show, o.out)).lexically_normal();
  // The plan does not list all frames, so that it stays one of all frames when the show changes
  // length.
  if (!o.frames.empty()) plan.frames = as_ranges(frames);
  if (!o.size.empty()) plan.options = {"--size", o.size};
  if (!o.overlays.empty()) plan.options.insert(plan.options.end(), {"--overlay", o.overlays});
  if (o.replace) plan.options.emplace_back("--replace");
  plan.engine = o.engine;
  plan.engine_options = o.engine_options;
  const bool local = o.engine == "local";
  const int processors = all_threads(0);
  plan.threads = o.threads > 0 ? o.threads : local ? processors : kTaskThreads;
  plan.at_once = local ? (o.workers > 0 ? o.workers : std::max(1, processors / 4)) : o.at_once;
  plan.retries = o.retries;
  plan.most_rounds = o.rounds;
  add_products(plan, o.products, show, frames);
  check_plan_text(plan);
  const FrameRun run{show, frames, plan.out, 0, false, true, o.replace, true};
  add_chunks(plan, o, show, frames_to_make(run));
  return plan;
}

}  // namespace domefall
