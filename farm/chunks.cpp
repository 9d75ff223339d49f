#include "farm/chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "farm/engine.h"
#include "pipeline/base/disk_room.h"
#include "pipeline/base/errors.h"
#include "pipeline/grade/grader.h"
#include "pipeline/image/frame_list.h"
#include "pipeline/render/frames/frame_folder.h"
#include "pipeline/render/render_time.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr double kTaskSeconds = 300;  // of a task where there is much to do
// To share the work among many, a show is cut into tasks no shorter than this.  The start of a
// process takes 0.55 s with a grade, which is a hundredth of it.
constexpr double kShortTaskSeconds = 60;
constexpr int kFewestFrames = 10;   // a task of so many spends little of its time on being started
constexpr int kManyMachines = 100;  // a show is cut for so many where its tasks stay long enough
constexpr int kLongestLocalChunk = 100;

struct FrameEstimate {
  std::vector<double> seconds;  // of each frame
  double bytes = 0;             // of a frame's files
};

// Returns what these frames take on a machine that does nothing else, with that many threads.  If
// they are not `measured`, each counts as 1 second, and its files as no bytes.  A few small frames
// are rendered in any case, which shows that what the show reads is there and can be read.
FrameEstimate estimate_frames(const Show& show, const std::vector<int>& frames, int threads,
                              bool measured) {
  Renderer renderer(show);
  if (!measured) {
    relative_light_costs(show, {frames.front(), frames.back()}, renderer);
    return {std::vector<double>(frames.size(), 1)};
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
  return {std::move(costs), time.linear_bytes + time.graded_bytes};
}

double size_of_file(const fs::path& file) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(file, none);
  return none ? 0 : static_cast<double>(size);
}

// Throws TemporaryError where even half of what was measured does not fit beside the files that
// stay.  `bytes` are those of a frame's files; without them each file takes a block of the disk.
void require_room_for_frames(const FarmPlan& plan, const Show& show, const std::vector<int>& frames,
                             double bytes) {
  constexpr double kBlock = 4096, kSurely = 0.5;
  const FrameFolder folder(plan.out, show);
  const auto files = static_cast<double>(folder.paths(0).size());
  const double least = bytes > 0 ? kSurely * bytes : kBlock * files;
  double replaced = 0;
  for (const int frame : frames)
    for (const fs::path& file : folder.paths(frame)) replaced += size_of_file(file);
  const auto count = static_cast<double>(frames.size());
  require_room(plan.out, count * least - replaced,
               fmt::format("{} frames take {}{}; another --out, --frames, or an output that keeps "
                           "less (linear: none; graded: png8 or jpeg) will do",
                           frames.size(), bytes > 0 ? "about " : "at least ",
                           bytes_text(count * (bytes > 0 ? bytes : least)) +
                               (bytes > 0 ? ", as some of them were measured" : "")));
}

int divided_up(int count, int by) { return (count + by - 1) / by; }

// Returns how many chunks to cut frames into that take `seconds` one after another on one machine.
// `seconds` is 0 where they have not been measured.
int chunk_count(const FarmPlan& plan, const Chunking& asked, int frames, double seconds) {
  const Engine& engine = engine_of(plan);
  const int most = engine.most_tasks(asked.only_printed);
  if (asked.frames > 0) {
    const int count = divided_up(frames, asked.frames);
    if (count > most)
      throw InputError(
          fmt::format("--chunk {}: {} frames would make more than the {} tasks that "
                      "{}; --chunk {} or more fits",
                      asked.frames, frames, most, engine.limit, divided_up(frames, most)));
    return count;
  }
  const bool local = engine.is_local;
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

// Halves chunks until the frames of each are written with `most` characters.  Frames that follow no
// rule need many.
std::vector<std::vector<int>> short_enough(const std::vector<std::vector<int>>& chunks,
                                           std::size_t most) {
  std::vector<std::vector<int>> shorter;
  for (const std::vector<int>& chunk : chunks) {
    if (as_ranges(chunk).size() <= most) {
      shorter.push_back(chunk);
      continue;
    }
    const auto middle = chunk.begin() + static_cast<long>(chunk.size() / 2);
    for (auto& half : short_enough({{chunk.begin(), middle}, {middle, chunk.end()}}, most))
      shorter.push_back(std::move(half));
  }
  return shorter;
}

std::vector<std::vector<int>> nameable_chunks(const std::vector<std::vector<int>>& chunks,
                                              const Engine& engine, bool only_printed) {
  std::vector<std::vector<int>> shorter = short_enough(chunks, engine.longest_frames);
  const int most = engine.most_tasks(only_printed);
  if (shorter.size() > static_cast<std::size_t>(most))
    throw InputError(fmt::format(
        "--frames: {} tasks are needed to name these frames, with {} characters each, and {} {}; "
        "frames in ranges, such as 0-599x10, need fewer",
        shorter.size(), engine.longest_frames, engine.limit, most));
  return shorter;
}

}  // namespace

std::vector<std::vector<int>> equal_chunks(const std::vector<int>& frames,
                                           const std::vector<double>& costs, int most) {
  const double share = std::accumulate(costs.begin(), costs.end(), 0.0) / most;
  std::vector<std::vector<int>> chunks;
  double before = 0;  // what all frames before this one cost
  int last_part = -1;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    // A frame belongs to the share of the whole in which its middle lies.
    const int part = static_cast<int>((before + costs[k] / 2) / share);
    if (part != last_part) chunks.emplace_back();
    chunks.back().push_back(frames[k]);
    last_part = part;
    before += costs[k];
  }
  return chunks;
}

void add_chunks(FarmPlan& plan, const Chunking& asked, const Show& show,
                const std::vector<int>& frames) {
  if (frames.empty()) return;
  const Engine& engine = engine_of(plan);
  const int threads = engine.is_local ? std::max(1, plan.threads / plan.at_once) : plan.threads;
  const bool measured = asked.frames == 0 && is_worth_measuring(show);
  const auto [seconds, bytes] = estimate_frames(show, frames, threads, measured);
  require_room_for_frames(plan, show, frames, bytes);
  const double all = measured ? std::accumulate(seconds.begin(), seconds.end(), 0.0) : 0;
  const int count = chunk_count(plan, asked, static_cast<int>(frames.size()), all);
  std::vector<std::vector<int>> chunks;
  if (asked.frames > 0)
    for (std::size_t first = 0, end = 0; first < frames.size(); first = end) {
      end = std::min(frames.size(), first + static_cast<std::size_t>(asked.frames));
      chunks.emplace_back(frames.begin() + static_cast<long>(first),
                          frames.begin() + static_cast<long>(end));
    }
  else
    chunks = equal_chunks(frames, seconds, count);
  if (engine.longest_frames != std::string::npos)
    chunks = nameable_chunks(chunks, engine, asked.only_printed);
  std::size_t next = 0;
  for (const std::vector<int>& chunk : chunks) {
    double estimate = 0;
    for (std::size_t k = 0; k < chunk.size(); ++k) estimate += seconds[next++];
    plan.chunks.push_back(
        {0, static_cast<int>(plan.chunks.size()), as_ranges(chunk), measured ? estimate : 0});
  }
}

}  // namespace domefall
